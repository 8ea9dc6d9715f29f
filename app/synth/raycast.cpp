#include "app/synth/raycast.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/synth/parallel.h"
#include "render/base/luminance.h"

namespace app::synth {

namespace {

constexpr int kTile = 16;
constexpr int kFirstStrata = 2;
constexpr std::size_t kOffsets = 1024;

// Offsets of equal probability of a pixel's box spread by a Gaussian: the box's distribution sampled finely, each
// point spread, sorted.
std::vector<float> offset_table(double blur_px) {
  std::vector<float> offsets(kOffsets);
  if (blur_px <= 0.0) {
    for (std::size_t i = 0; i < kOffsets; ++i) offsets[i] = (static_cast<float>(i) + 0.5F) / kOffsets - 0.5F;
    return offsets;
  }
  // Distribution function of box * Gaussian: F(x) = integral of Phi over [x - 1/2, x + 1/2]; inverted by walking x.
  const double reach = 0.5 + 4.0 * blur_px;
  const auto phi_integral = [&](double x) {  // antiderivative of the normal distribution function
    const double z = x / blur_px;
    return x * 0.5 * std::erfc(-z / std::sqrt(2.0)) +
           blur_px * std::exp(-0.5 * z * z) / std::sqrt(2.0 * 3.14159265358979);
  };
  const int steps = 20000;
  std::size_t next = 0;
  for (int i = 0; i <= steps && next < kOffsets; ++i) {
    const double x = -reach + 2.0 * reach * i / steps;
    const double share = phi_integral(x + 0.5) - phi_integral(x - 0.5);
    while (next < kOffsets && share >= (static_cast<double>(next) + 0.5) / kOffsets)
      offsets[next++] = static_cast<float>(x);
  }
  while (next < kOffsets) offsets[next++] = static_cast<float>(reach);
  return offsets;
}

glm::vec3 to_float(const cv::Vec3d& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

// What the eye makes of a difference: about the square root of the light.
float brightness(const glm::vec3& rgb) {
  return std::sqrt(std::min(std::max(render::rec709_luminance(rgb.r, rgb.g, rgb.b), 0.0F), 1.5F));
}

}  // namespace

LensGrid::LensGrid(const ar::CameraModel& camera) : width_(camera.width), height_(camera.height) {
  std::vector<cv::Point2d> pixels;
  pixels.reserve(static_cast<std::size_t>(width_ + 1) * static_cast<std::size_t>(height_ + 1));
  for (int y = 0; y <= height_; ++y)
    for (int x = 0; x <= width_; ++x) pixels.emplace_back(x - 0.5, y - 0.5);  // OpenCV counts from pixel centres
  for (const cv::Point2d& p : ar::undistort_to_ideal(camera, pixels))
    corners_.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y));
}

glm::vec2 LensGrid::ideal(float u, float v) const {
  const int x = std::clamp(static_cast<int>(u), 0, width_ - 1);
  const int y = std::clamp(static_cast<int>(v), 0, height_ - 1);
  const float fx = u - static_cast<float>(x);
  const float fy = v - static_cast<float>(y);
  const glm::vec2* const row = corners_.data() + static_cast<std::ptrdiff_t>(y) * (width_ + 1) + x;
  const glm::vec2* const below = row + width_ + 1;
  return (row[0] * (1.0F - fx) + row[1] * fx) * (1.0F - fy) + (below[0] * (1.0F - fx) + below[1] * fx) * fy;
}

struct RayCaster::Shot {
  std::uint32_t seed = 0;
  std::vector<glm::vec3> eye;  // one a time slice
  std::vector<glm::mat3> world_from_camera;
  float reach_m = 0.0F;    // how far the eye moves, and
  float reach_rad = 0.0F;  // how far the view turns, from the middle of the shutter time
};

RayCaster::RayCaster(const Spec& spec, const World& world, const CameraPath& path)
    : spec_(spec),
      world_(world),
      path_(path),
      lens_(spec.camera),
      pixel_rad_(static_cast<float>(1.0 / spec.camera.intrinsics(0, 0))),
      exposure_(static_cast<float>(world.light().exposure())),
      strata_(std::max(kFirstStrata, static_cast<int>(std::lround(std::sqrt(spec.samples))))),
      inside_(offset_table(spec.blur_px)) {}

LinearFrame RayCaster::render(int frame) const {
  Shot shot;
  shot.seed = mix_bits(spec_.seed * 7919U + static_cast<std::uint32_t>(frame));
  const int slices = strata_ * strata_;
  for (int i = 0; i < slices; ++i) {
    const double share = (i + 0.5) / slices - 0.5;
    const ar::Rigid3 pose = path_.world_from_camera(spec_.time_of_frame_s(frame) + share * spec_.shutter_s);
    glm::mat3 rotation;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) rotation[column][row] = static_cast<float>(pose.rotation(row, column));
    shot.eye.push_back(to_float(pose.translation));
    shot.world_from_camera.push_back(rotation);
  }
  const auto middle = static_cast<std::size_t>(slices / 2);
  for (const std::size_t end : {std::size_t{0}, shot.eye.size() - 1}) {
    shot.reach_m = std::max(shot.reach_m, glm::length(shot.eye[end] - shot.eye[middle]));
    for (int column = 0; column < 3; ++column) {
      const glm::vec3 change = shot.world_from_camera[end][column] - shot.world_from_camera[middle][column];
      shot.reach_rad = std::max(shot.reach_rad, 2.0F * glm::length(change));
    }
  }
  LinearFrame out{spec_.width, spec_.height, {}};
  out.rgb.resize(static_cast<std::size_t>(spec_.width) * static_cast<std::size_t>(spec_.height));
  const int columns = (spec_.width + kTile - 1) / kTile;
  const int rows = (spec_.height + kTile - 1) / kTile;
  parallel_for(columns * rows, [&](int i) { render_tile(shot, i % columns, i / columns, out); });
  return out;
}

void RayCaster::render_tile(const Shot& shot, int tile_x, int tile_y, LinearFrame& out) const {
  const int x0 = tile_x * kTile;
  const int y0 = tile_y * kTile;
  const int x1 = std::min(x0 + kTile, out.width);
  const int y1 = std::min(y0 + kTile, out.height);
  const std::size_t middle = shot.eye.size() / 2;
  const auto look = [&](float u, float v) {
    return glm::normalize(shot.world_from_camera[middle] * glm::vec3(lens_.ideal(u, v), 1.0F));
  };
  const glm::vec3 axis = look(0.5F * static_cast<float>(x0 + x1), 0.5F * static_cast<float>(y0 + y1));
  float half_angle = 0.0F;
  const float margin = 1.0F + 4.0F * static_cast<float>(spec_.blur_px);
  for (const float u : {static_cast<float>(x0) - margin, static_cast<float>(x1) + margin}) {
    for (const float v : {static_cast<float>(y0) - margin, static_cast<float>(y1) + margin}) {
      const glm::vec3 corner = look(u, v);
      // Where the lens has no inverse nothing is known of the tile's cone: everything may be in it.
      half_angle = std::isfinite(corner.x) && std::isfinite(axis.x)
                       ? std::max(half_angle, std::acos(glm::clamp(glm::dot(axis, corner), -1.0F, 1.0F)))
                       : 3.2F;
    }
  }
  Candidates among;
  constexpr float kNearestM = 0.5F;  // things nearer than that are looked at anyway, by their own radius
  world_.candidates(shot.eye[middle], std::isfinite(axis.x) ? axis : glm::vec3(0.0F, 0.0F, 1.0F),
                    half_angle + shot.reach_rad + shot.reach_m / kNearestM + 1e-3F, among);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      out.rgb[static_cast<std::size_t>(y) * static_cast<std::size_t>(out.width) + static_cast<std::size_t>(x)] =
          pixel(shot, x, y, among);
    }
  }
}

Radiance RayCaster::sample(const Shot& shot, float u, float v, std::size_t time_slice, const RayFilter& filter,
                           const Candidates& among, Random& random) const {
  const glm::vec2 ideal = lens_.ideal(u, v);
  if (!std::isfinite(ideal.x)) return {};
  const glm::vec3 direction = glm::normalize(shot.world_from_camera[time_slice] * glm::vec3(ideal, 1.0F));
  return world_.trace(shot.eye[time_slice], direction, filter, among, random);
}

namespace {

// What a pixel's first samples have in common.
class Agreement {
 public:
  void add(const Radiance& seen, float level) {
    if (level_low_ > level_high_) thing_ = seen.thing;
    one_thing_ = one_thing_ && seen.thing == thing_;
    tag_ = tag_ || seen.tag;
    level_low_ = std::min(level_low_, level);
    level_high_ = std::max(level_high_, level);
    sun_low_ = std::min(sun_low_, seen.sun_share);
    sun_high_ = std::max(sun_high_, seen.sun_share);
  }
  // Whether they will do: each is filtered over its own share of the pixel, so what differs within one evenly lit thing
  // is texture and already right; edges of things and of shadows are points on one side or the other.
  bool suffices() const {
    constexpr float kCalm = 0.06F;
    constexpr float kTexture = 0.16F;  // coarser than that, the texture is seen too slantwise for the filter's circle
    constexpr float kEvenSun = 0.2F;
    const bool even = one_thing_ && sun_high_ - sun_low_ < kEvenSun;
    return !tag_ && level_high_ - level_low_ < (even ? kTexture : kCalm);
  }

 private:
  int thing_ = -1;
  bool one_thing_ = true;
  bool tag_ = false;
  float level_low_ = 1e9F, level_high_ = -1e9F;
  float sun_low_ = 1e9F, sun_high_ = -1e9F;
};

}  // namespace

// A few samples first, in the middles of their strata; where they disagree, or a tag is seen, all of them anew,
// anywhere in theirs. The first ones are then thrown away: deciding by a sample and keeping it would favour what
// decided.
glm::vec3 RayCaster::pixel(const Shot& shot, int x, int y, const Candidates& among) const {
  Random random(hash_cell(x, y, shot.seed));
  const std::size_t slices = shot.eye.size();
  const auto gather = [&](int side, bool scattered, Agreement& agreement) {
    const int count = side * side;
    const int shift = static_cast<int>(random.next() * static_cast<float>(count));
    const float spread = pixel_rad_ / static_cast<float>(side);
    glm::vec3 sum(0.0F);
    for (int i = 0; i < count; ++i) {
      const auto offset = [&](int stratum) {
        const float within = scattered ? random.next() : 0.5F;
        const float place = (static_cast<float>(stratum) + within) / static_cast<float>(side);
        return inside_[std::min(static_cast<std::size_t>(place * kOffsets), kOffsets - 1)];
      };
      const float u = static_cast<float>(x) + 0.5F + offset(i % side);
      const float v = static_cast<float>(y) + 0.5F + offset(i / side);
      const int turn = (i * 7 + shift) % count;  // each stratum of time once, in another order in each pixel
      const float instant = (static_cast<float>(turn) + random.next()) / static_cast<float>(count);
      const auto slice = static_cast<std::size_t>(instant * static_cast<float>(slices));
      const RayFilter filter{spread, (static_cast<float>((i * 3 + shift) % count) + 0.5F) / static_cast<float>(count)};
      const Radiance seen = sample(shot, u, v, std::min(slice, slices - 1), filter, among, random);
      const glm::vec3 light = seen.luminance_rgb * exposure_;
      sum += light;
      agreement.add(seen, brightness(light));
    }
    return sum / static_cast<float>(count);
  };
  Agreement agreement;
  const glm::vec3 first = gather(kFirstStrata, strata_ == kFirstStrata, agreement);
  if (strata_ == kFirstStrata || agreement.suffices()) return first;
  return gather(strata_, true, agreement);
}

}  // namespace app::synth
