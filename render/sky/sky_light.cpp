#include "render/sky/sky_light.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/sky/hemisphere.h"

namespace render {
namespace {

// Band of each coefficient.
constexpr std::array<int, 9> kBand = {0, 1, 1, 1, 2, 2, 2, 2, 2};

// Ramamoorthi & Hanrahan 2001, eq. 3.
std::array<double, 9> basis(const glm::dvec3& n) {
  return {0.282095,
          0.488603 * n.y,
          0.488603 * n.z,
          0.488603 * n.x,
          1.092548 * n.x * n.y,
          1.092548 * n.y * n.z,
          0.315392 * (3.0 * n.z * n.z - 1.0),
          1.092548 * n.x * n.z,
          0.546274 * (n.x * n.x - n.y * n.y)};
}

// Each band multiplied by its factor, evaluated in a direction, not below 0.
glm::dvec3 evaluate(const Sh9& sh, const glm::dvec3& band_factors, const glm::dvec3& direction) {
  const std::array<double, 9> y = basis(glm::normalize(direction));
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < sh.size(); ++i) sum += sh[i] * (y[i] * band_factors[kBand[i]]);
  return glm::max(sum, glm::dvec3(0.0));
}

}  // namespace

void add_to_sh(Sh9& sh, const glm::dvec3& direction_in_world, const glm::dvec3& luminance_rgb, double solid_angle_sr) {
  const std::array<double, 9> y = basis(direction_in_world);
  for (std::size_t i = 0; i < sh.size(); ++i) sh[i] += luminance_rgb * (y[i] * solid_angle_sr);
}

SkyLight sky_light(const SkyModel& sky, const glm::dvec3& sun_horizontal_illuminance_rgb, double ground_albedo) {
  SkyLight light;
  for (const SolidAngleSample& sample : upper_hemisphere()) {
    const glm::dvec3 radiance = sky.luminance_rgb(sample.direction_in_world);
    add_to_sh(light.radiance_sh, sample.direction_in_world, radiance, sample.solid_angle_sr);
    light.horizontal_illuminance_rgb += radiance * (sample.direction_in_world.z * sample.solid_angle_sr);
  }
  light.ground_luminance_rgb =
      (light.horizontal_illuminance_rgb + sun_horizontal_illuminance_rgb) * (ground_albedo / std::numbers::pi);
  for (const SolidAngleSample& sample : upper_hemisphere()) {
    const glm::dvec3& up = sample.direction_in_world;
    add_to_sh(light.radiance_sh, {up.x, up.y, -up.z}, light.ground_luminance_rgb, sample.solid_angle_sr);
  }
  return light;
}

glm::dvec3 irradiance(const Sh9& radiance_sh, const glm::dvec3& normal_in_world) {
  constexpr double kPi = std::numbers::pi;
  return evaluate(radiance_sh, {kPi, 2.0 * kPi / 3.0, kPi / 4.0}, normal_in_world);
}

glm::dvec3 in_scatter_luminance(const Sh9& radiance_sh, PhaseFunction function, double g,
                                const glm::dvec3& view_direction_in_world) {
  return evaluate(radiance_sh, phase_moments(function, g), view_direction_in_world);
}

}  // namespace render
