#include "render/sky/clouds.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "render/medium/medium.h"
#include "render/sky/direction.h"
#include "render/sky/hemisphere.h"
#include "render/sky/perlin.h"
#include "render/sky/smooth_step.h"

namespace render {
namespace {

constexpr double kEarthRadiusM = 6371000.0;
constexpr double kHazeM = 45000.0;        // clouds farther than that take on the sky's own colour
constexpr double kResolutionRad = 0.002;  // finer detail is left out
constexpr double kOneMinusG = 0.15;       // 1 - g of cloud droplets

double shell_distance_m(double height_m, double sin_elevation) {
  const double rz = kEarthRadiusM * sin_elevation;
  return std::sqrt(rz * rz + 2.0 * kEarthRadiusM * height_m + height_m * height_m) - rz;
}

// Optical depth straight up through a layer where a ray meets it.
double depth_at(const CloudLayer& layer, const glm::dvec3& view, double time_s, std::uint32_t seed) {
  const double distance = shell_distance_m(layer.height_m, view.z);
  const double drift = layer.speed_mps * time_s;
  const double x = (view.x * distance - drift * std::sin(layer.heading_rad)) / layer.size_m;
  const double y = (view.y * distance - drift * std::cos(layer.heading_rad)) / layer.size_m;
  const double finest = distance * kResolutionRad / std::max(view.z, 0.03) / layer.size_m;
  const Octaves noise =
      perlin_octaves(x, y, time_s / layer.change_s, layer.octaves, layer.persistence, std::max(finest, 1e-6), seed);
  // Noise is about normal: its distribution function makes it even over [0, 1], so that coverage is a share of area.
  const double rank = 1.0 / (1.0 + std::exp(-1.702 * noise.value));
  // Detail too fine to see leaves its mean: edges widen by its spread.
  const double width = std::hypot(layer.softness, 1.2 * noise.lost);
  const double middle = 1.0 - layer.coverage + 0.5 * layer.softness;
  const double inside = smooth_step(middle - 0.5 * width, middle + 0.5 * width, rank);
  return layer.optical_depth * inside * (0.4 + 0.6 * rank);
}

// Share of light that leaves the far side of a cloud in whatever direction (two-stream approximation).
double diffuse_transmission(double depth) {
  return 1.0 / (1.0 + 0.75 * kOneMinusG * depth);
}

// Light that droplets send on: mostly forwards, which makes the bright rims near the sun.
double droplet_phase(double cosine) {
  return 0.7 * phase(PhaseFunction::HenyeyGreenstein, 0.80, cosine) +
         0.3 * phase(PhaseFunction::HenyeyGreenstein, -0.10, cosine);
}

class CloudySky final : public SkyModel {
 public:
  CloudySky(std::unique_ptr<SkyModel> sky, std::vector<CloudLayer> layers, std::vector<CloudLight> lights,
            double time_s, std::uint32_t seed)
      : sky_(std::move(sky)),
        layers_(std::move(layers)),
        lights_(std::move(lights)),
        time_s_(time_s),
        seed_(seed),
        sky_illuminance_(horizontal_illuminance(*sky_)) {
    std::sort(layers_.begin(), layers_.end(),
              [](const CloudLayer& a, const CloudLayer& b) { return a.height_m > b.height_m; });
  }

  glm::dvec3 luminance_rgb(const glm::dvec3& direction_in_world) const override {
    const glm::dvec3 view = above_horizon(direction_in_world);
    const glm::dvec3 behind = sky_->luminance_rgb(view);
    glm::dvec3 seen = behind;
    for (std::size_t i = 0; i < layers_.size(); ++i) {  // from the highest down
      const double depth = depth_at(layers_[i], view, time_s_, seed_of(i));
      if (depth <= 0.0) continue;
      const double slant = depth / std::max(view.z, 0.2);
      const double haze = std::exp(-shell_distance_m(layers_[i].height_m, view.z) / kHazeM);
      const glm::dvec3 cloud = glm::mix(behind, cloud_luminance(view, depth), haze);
      seen = glm::mix(cloud, seen, std::exp(-slant));
    }
    return seen;
  }

  double transmittance(const glm::dvec3& direction_in_world) const override {
    const glm::dvec3 towards = glm::normalize(direction_in_world);
    if (towards.z < -0.02) return 1.0;  // the ground is in the way, not the clouds
    const glm::dvec3 view = above_horizon(towards);
    double depth = 0.0;
    for (std::size_t i = 0; i < layers_.size(); ++i) depth += depth_at(layers_[i], view, time_s_, seed_of(i));
    return std::exp(-depth / std::max(view.z, 0.1)) * sky_->transmittance(direction_in_world);
  }

 private:
  std::uint32_t seed_of(std::size_t layer) const { return seed_ * 64U + static_cast<std::uint32_t>(layer) * 16U; }

  glm::dvec3 cloud_luminance(const glm::dvec3& view, double depth) const {
    const double through = diffuse_transmission(depth);
    // The underside darkens towards the horizon as a standard overcast does (Moon & Spencer 1942).
    const double gradation = (1.0 + 2.0 * view.z) / 3.0 * 9.0 / 7.0;
    const double thick = 1.0 - std::exp(-0.2 * depth);
    const double spread = glm::mix(1.0, gradation, thick) / std::numbers::pi;
    glm::dvec3 sum = sky_illuminance_ * (spread * glm::mix(1.0, through, thick));
    for (const CloudLight& light : lights_) {
      const double cosine = angle_between(view, light.direction_in_world).cosine;
      const double level = std::max(light.direction_in_world.z, 0.05) * spread * through;
      const double forward = droplet_phase(cosine) * std::exp(-kOneMinusG * 3.0 * depth);
      sum += light.illuminance_rgb * (level + forward);
    }
    return sum;
  }

  std::unique_ptr<SkyModel> sky_;
  std::vector<CloudLayer> layers_;
  std::vector<CloudLight> lights_;
  double time_s_;
  std::uint32_t seed_;
  glm::dvec3 sky_illuminance_;
};

}  // namespace

std::unique_ptr<SkyModel> make_cloudy_sky(std::unique_ptr<SkyModel> sky, std::vector<CloudLayer> layers,
                                          std::vector<CloudLight> lights, double time_s, std::uint32_t seed) {
  return std::make_unique<CloudySky>(std::move(sky), std::move(layers), std::move(lights), time_s, seed);
}

}  // namespace render
