#include "render/shafts/reference/shaft_reference.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <limits>
#include <mutex>
#include <numbers>
#include <thread>

#include "render/shafts/reference/endless.h"
#include "render/sky/patches.h"
#include "render/sky/sky_light.h"

namespace render {
namespace {

constexpr int kFirstDiscSamples = 32;

bool dark(const glm::dvec3& rgb) {
  return rgb == glm::dvec3(0.0);
}

double largest(const glm::dvec3& v) {
  return std::max({v.x, v.y, v.z});
}

// Any two unit vectors across a direction.
glm::dmat3 frame_about(const glm::dvec3& direction) {
  const glm::dvec3 other = std::abs(direction.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 u = glm::normalize(glm::cross(direction, other));
  return {u, glm::cross(direction, u), direction};
}

// The i-th of a sequence of directions that fill a disc evenly [Roberts 2018, R2 sequence: plastic number], mapped with
// equal solid angles.
glm::dvec3 in_disc(int i, const glm::dmat3& frame, double angular_radius_rad) {
  constexpr double kPlastic = 1.32471795724474602596;
  const double u = std::fmod(0.5 + (i + 1) / kPlastic, 1.0);
  const double v = std::fmod(0.5 + (i + 1) / (kPlastic * kPlastic), 1.0);
  const double half_versine = std::sin(0.5 * angular_radius_rad);
  const double versine = 2.0 * half_versine * half_versine * u;  // 1 - cos
  const double sine = std::sqrt(versine * (2.0 - versine));
  const double turn = 2.0 * std::numbers::pi * v;
  return frame * glm::dvec3(sine * std::cos(turn), sine * std::sin(turn), 1.0 - versine);
}

// Scenes that give sky light but no sky (tests): the luminance that its harmonics stand for.
class HarmonicSky : public SkyModel {
 public:
  explicit HarmonicSky(const Sh9& radiance_sh) : radiance_sh_(radiance_sh) {}

  glm::dvec3 luminance_rgb(const glm::dvec3& direction_in_world) const override {
    const glm::dvec3 d = glm::normalize(direction_in_world);
    const auto& c = radiance_sh_;
    const glm::dvec3 value = 0.28209479177387814 * c[0] + 0.48860251190291992 * (d.y * c[1] + d.z * c[2] + d.x * c[3]) +
                             1.0925484305920792 * (d.x * d.y * c[4] + d.y * d.z * c[5] + d.x * d.z * c[7]) +
                             0.31539156525252005 * (3.0 * d.z * d.z - 1.0) * c[6] +
                             0.54627421529603960 * (d.x * d.x - d.y * d.y) * c[8];
    return glm::max(value, glm::dvec3(0.0));
  }

 private:
  Sh9 radiance_sh_;
};

}  // namespace

ShaftReference::ShaftReference(const SceneState& scene, const ReferenceSettings& settings)
    : scene_(scene),
      settings_(settings),
      reference_medium_{*scene.medium, settings.density},
      occluders_(scene.instances) {
  Sun& sun = ensure_sun(scene_);
  sun.direction_in_world = glm::normalize(sun.direction_in_world);
  sun.illuminance_rgb *= scene.medium->shaft_gain;
  if (settings_.sky != ReferenceSky::Traced) return;
  sky_ = sky_samples(settings_.max_error);
  coarse_sky_ = sky_samples(4.0 * settings_.max_error);
}

// The sky above, and below the horizon ground as bright as SkyLight takes it to be.
std::vector<ShaftReference::SkySample> ShaftReference::sky_samples(double max_error) const {
  const HarmonicSky harmonic(scene_.sky_light.radiance_sh);
  const SkyModel& sky = scene_.sky ? *scene_.sky : harmonic;
  if (dark(scene_.sky_light.radiance_sh[0])) return {};
  const SkyPatches patches = make_patches(sky, {.tessellation = "geodesic", .max_error = max_error});
  const glm::dvec3 ground = irradiance(scene_.sky_light.radiance_sh, {0.0, 0.0, -1.0}) / std::numbers::pi;
  std::vector<SkySample> samples;
  for (const SkyPatch& patch : patches.patches()) {
    const glm::dvec3 up = glm::normalize(patch.direction_in_world);
    const glm::dvec3 down(up.x, up.y, -up.z);
    const double weight = patch.solid_angle_sr * scene_.medium->fog_gain;
    samples.push_back({up, patch.luminance_rgb * weight});
    samples.push_back({down, (scene_.sky ? ground : harmonic.luminance_rgb(down)) * weight});
  }
  std::erase_if(samples, [](const SkySample& sample) { return dark(sample.illuminance_rgb); });
  return samples;
}

ReferenceLight ShaftReference::along(const ViewRay& ray, double end_m) const {
  ReferenceLight out;
  if (reference_medium_.medium.extinction_per_m == 0.0) return out;
  const std::optional<Segment> segment = inside(reference_medium_.medium.extent, ray, end_m);
  if (!segment) return out;
  const MediumRay path(reference_medium_, ray, segment->from_m);
  out.transmittance = std::exp(-path.view_depth(segment->to_m));
  sun_light(ray, path, *segment, out);
  sky_light(ray, path, *segment, out);
  for (const PointLight& light : settings_.lights) point_light(light, ray, path, *segment, out);
  return out;
}

// Light from one direction, as if all of the sun's came from there.
glm::dvec3 ShaftReference::sun_from(const glm::dvec3& direction, const ViewRay& ray, const MediumRay& path,
                                    const Segment& segment, glm::dvec3& error) const {
  const Medium& medium = reference_medium_.medium;
  const double scale =
      medium.albedo * phase(medium.phase_function, medium.g, glm::dot(direction, ray.direction_in_world));
  const glm::dvec3 light = sun_of(scene_).illuminance_rgb * scale;
  glm::dvec3 sum(0.0);
  for (const LitSegment& lit : ShadowSheet(occluders_).lit(ray, {direction, true}, segment.from_m, segment.to_m)) {
    const Quadrature fraction = path.sunlit_fraction(lit, direction);
    sum += light * lit.through_rgb * fraction.value;
    error += light * lit.through_rgb * fraction.error;
  }
  return sum;
}

// The mean over the disc, from twice as many directions each time until two means agree.
void ShaftReference::sun_light(const ViewRay& ray, const MediumRay& path, const Segment& segment,
                               ReferenceLight& out) const {
  const Sun& sun = sun_of(scene_);
  if (dark(sun.illuminance_rgb)) return;
  if (sun.angular_radius_rad <= 0.0) {
    out.luminance_rgb += sun_from(sun.direction_in_world, ray, path, segment, out.error_rgb);
    return;
  }
  const glm::dmat3 frame = frame_about(sun.direction_in_world);
  glm::dvec3 sum(0.0);
  glm::dvec3 error_sum(0.0);
  glm::dvec3 before(0.0);
  int done = 0;
  for (int samples = kFirstDiscSamples; samples <= std::max(settings_.max_disc_samples, 2 * kFirstDiscSamples);
       samples *= 2) {
    before = done > 0 ? sum / static_cast<double>(done) : before;
    for (; done < samples; ++done) {
      sum += sun_from(in_disc(done, frame, sun.angular_radius_rad), ray, path, segment, error_sum);
    }
    const glm::dvec3 mean = sum / static_cast<double>(done);
    const bool agree = largest(glm::abs(mean - before)) <= settings_.max_error * largest(mean);
    if (samples > kFirstDiscSamples && agree) break;
  }
  const glm::dvec3 mean = sum / static_cast<double>(done);
  out.luminance_rgb += mean;
  out.error_rgb += glm::abs(mean - before) + error_sum / static_cast<double>(done);
}

glm::dvec3 ShaftReference::traced_sky(const std::vector<SkySample>& sky, const ViewRay& ray, const MediumRay& path,
                                      const Segment& segment) const {
  const Medium& medium = reference_medium_.medium;
  const ShadowSheet sheet(occluders_);
  glm::dvec3 sum(0.0);
  for (const SkySample& sample : sky) {
    const double scale = medium.albedo * phase(medium.phase_function, medium.g,
                                               glm::dot(sample.direction_in_world, ray.direction_in_world));
    for (const LitSegment& lit : sheet.lit(ray, {sample.direction_in_world, true}, segment.from_m, segment.to_m)) {
      sum += sample.illuminance_rgb * lit.through_rgb * (scale * path.fraction(lit).value);
    }
  }
  return sum;
}

void ShaftReference::sky_light(const ViewRay& ray, const MediumRay& path, const Segment& segment,
                               ReferenceLight& out) const {
  const Medium& medium = reference_medium_.medium;
  if (settings_.sky == ReferenceSky::None || dark(scene_.sky_light.radiance_sh[0])) return;
  if (settings_.sky == ReferenceSky::Open) {
    const glm::dvec3 light =
        in_scatter_luminance(scene_.sky_light.radiance_sh, medium.phase_function, medium.g, ray.direction_in_world);
    out.luminance_rgb += light * (medium.fog_gain * medium.albedo *
                                  path.fraction({.from_m = segment.from_m, .to_m = segment.to_m}).value);
    return;
  }
  const glm::dvec3 fine = traced_sky(sky_, ray, path, segment);
  out.luminance_rgb += fine;
  out.error_rgb += glm::abs(fine - traced_sky(coarse_sky_, ray, path, segment));
}

void ShaftReference::point_light(const PointLight& light, const ViewRay& ray, const MediumRay& path,
                                 const Segment& segment, ReferenceLight& out) const {
  const glm::dvec3 scale = light.luminous_intensity_rgb * reference_medium_.medium.albedo;
  for (const LitSegment& lit :
       ShadowSheet(occluders_).lit(ray, {light.position_in_world, false}, segment.from_m, segment.to_m)) {
    const Quadrature fraction = path.point_fraction(lit, light.position_in_world);
    out.luminance_rgb += scale * lit.through_rgb * fraction.value;
    out.error_rgb += scale * lit.through_rgb * fraction.error;
  }
}

// A depth buffer holds 1 - near / z in single precision: what the ray really ends on is a little before or behind.
double ShaftReference::end_on_surface(const ViewRay& ray, double axis_distance_m, double metres_per_z) const {
  if (axis_distance_m >= 1e9) return kEndless;
  const double end = axis_distance_m * metres_per_z;
  const double doubt = 1e-5 + 2.4e-7 * axis_distance_m / View::kNearM;
  const double hit = ShadowSheet(occluders_).first_hit_m(ray, end * (1.0 - doubt), end * (1.0 + doubt));
  return std::isinf(hit) ? end : hit;
}

// What one thread adds up over its rows.
struct ShaftReference::Tally {
  double light = 0.0;
  double error = 0.0;
  double most_light = 0.0;
  double most_error = 0.0;

  void add(const ReferenceLight& pixel) {
    light += largest(pixel.luminance_rgb);
    error += largest(pixel.error_rgb);
    most_light = std::max(most_light, largest(pixel.luminance_rgb));
    most_error = std::max(most_error, largest(pixel.error_rgb));
  }
  void add(const Tally& other) {
    light += other.light;
    error += other.error;
    most_light = std::max(most_light, other.most_light);
    most_error = std::max(most_error, other.most_error);
  }
};

ShaftReference::Tally ShaftReference::row(const View& view, int y, std::span<const float> axis_distance_m,
                                          ReferencePicture& out) const {
  Tally tally;
  const glm::dmat3 ray_from_px = view.local_ray_from_px();
  for (int x = 0; x < view.width; ++x) {
    const auto index = static_cast<std::size_t>(y) * static_cast<std::size_t>(view.width) + static_cast<std::size_t>(x);
    const glm::dvec3 towards = ray_from_px * glm::dvec3(x + 0.5, y + 0.5, 1.0);
    const double metres_per_z = glm::length(towards);
    const ViewRay ray{view.eye_in_world, towards / metres_per_z};
    const double end = axis_distance_m.empty() ? kEndless : end_on_surface(ray, axis_distance_m[index], metres_per_z);
    const ReferenceLight light = along(ray, end);
    out.rgba[index] = glm::vec4(glm::vec3(light.luminance_rgb), static_cast<float>(light.transmittance));
    tally.add(light);
  }
  return tally;
}

ReferencePicture ShaftReference::picture(const View& view, std::span<const float> axis_distance_m,
                                         const std::function<void(int rows)>& progress) const {
  ReferencePicture out{.width = view.width, .height = view.height, .rgba = {}};
  out.rgba.resize(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height));
  std::atomic<int> next{0};
  std::mutex telling;
  int rows = 0;
  const auto work = [&] {
    Tally tally;
    for (int y = next++; y < view.height; y = next++) {
      tally.add(row(view, y, axis_distance_m, out));
      const std::lock_guard lock(telling);
      ++rows;
      if (progress) progress(rows);
    }
    return tally;
  };
  std::vector<std::future<Tally>> running;
  for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i) {
    running.push_back(std::async(std::launch::async, work));
  }
  Tally all;
  for (std::future<Tally>& worker : running) all.add(worker.get());
  if (all.most_light > 0.0) {
    out.mean_error = all.error / all.light;
    out.largest_error = all.most_error / all.most_light;
  }
  return out;
}

}  // namespace render
