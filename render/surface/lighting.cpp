#include "render/surface/lighting.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/base/luminance.h"

namespace render {

Lighting lighting_of(const SceneState& scene) {
  // The cosine lobe's bands: Ramamoorthi & Hanrahan 2001, eq. 8.
  constexpr double kPi = std::numbers::pi;
  constexpr std::array<double, 9> kCosine{kPi,     2 * kPi / 3, 2 * kPi / 3, 2 * kPi / 3, kPi / 4,
                                          kPi / 4, kPi / 4,     kPi / 4,     kPi / 4};
  Lighting light;
  light.sun_direction = glm::vec3(glm::normalize(sun_of(scene).direction_in_world));
  light.sun_illuminance = glm::vec3(sun_of(scene).illuminance_rgb * scene.exposure);
  light.sun_disc_slope = static_cast<float>(std::tan(sun_of(scene).angular_radius_rad));
  for (std::size_t i = 0; i < 9; ++i) {
    light.sky_irradiance_sh[i] = glm::vec3(scene.sky_light.radiance_sh[i] * (scene.exposure * kCosine[i]));
  }
  const glm::dvec3 level = scene.sky_light.horizontal_illuminance_rgb +
                           sun_of(scene).illuminance_rgb * std::max(sun_of(scene).direction_in_world.z, 0.0);
  light.white_luminance = static_cast<float>(rec709_luminance(level.x, level.y, level.z) * scene.exposure / kPi);
  return light;
}

void Lighting::set(const gl::Program& program) const {
  program.set("sun_direction_in_local", sun_direction);
  program.set("sun_illuminance", sun_illuminance);
  program.set("sun_disc_slope", sun_disc_slope);
  program.set("sky_irradiance_sh", sky_irradiance_sh.data(), 9);
  if (program.has("white_luminance")) program.set("white_luminance", white_luminance);  // emission's unit
}

}  // namespace render
