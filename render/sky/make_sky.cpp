#include <cmath>
#include <stdexcept>

#include "render/sky/clouds.h"
#include "render/sky/night_sky.h"
#include "render/sky/sky_models.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

std::unique_ptr<SkyModel> cloudless(const SkyOptions& options, const SunPosition& sun) {
  const SkyModelInfo* model = find_sky_model(options.model);
  if (model == nullptr) {
    throw std::runtime_error("unknown sky model `" + options.model + "`\nknown models: " + known_sky_models());
  }
  return model->make(options, sun);
}

std::unique_ptr<SkyModel> with_night(std::unique_ptr<SkyModel> sky, const SkyOptions& options, const SunPosition& sun) {
  if (sun.elevation_rad >= 0.0) return sky;
  const double moon_share = options.moon ? moon_to_sun(*options.moon) : 0.0;
  std::unique_ptr<SkyModel> moonlit;
  if (moon_share > 0.0) moonlit = cloudless({.model = "perez", .turbidity = options.turbidity}, as_sun(*options.moon));
  return make_night_sky(std::move(sky), std::move(moonlit), moon_share);
}

// Clouds still see the sun when the ground no longer does.
CloudLight sun_on_clouds(const SunPosition& sun, double turbidity, double height_m) {
  const double dip_rad = std::sqrt(2.0 * height_m / 6371000.0);
  SunPosition seen = sun;
  seen.apparent_elevation_rad += dip_rad;
  return {sun.apparent_direction_in_world(), sun_light(seen, turbidity, height_m).illuminance_rgb};
}

std::unique_ptr<SkyModel> with_clouds(std::unique_ptr<SkyModel> sky, const SkyOptions& options,
                                      const SunPosition& sun) {
  std::vector<CloudLayer> layers = cloud_preset(options.clouds.preset);
  if (layers.empty()) return sky;
  std::vector<CloudLight> lights{sun_on_clouds(sun, options.turbidity, layers.front().height_m)};
  if (options.moon && sun.elevation_rad < 0.0) {
    lights.push_back(
        {options.moon->apparent_direction_in_world(), moon_illuminance_rgb(*options.moon, options.turbidity)});
  }
  return make_cloudy_sky(std::move(sky), std::move(layers), std::move(lights), options.clouds.time_s,
                         options.clouds.seed);
}

}  // namespace

glm::dvec3 SkyModel::luminance_xyz(const glm::dvec3& direction_in_world) const {
  return xyz_from_rgb(luminance_rgb(direction_in_world));
}

std::unique_ptr<SkyModel> make_sky(const SkyOptions& options, const SunPosition& sun) {
  if (options.model == "none") return cloudless(options, sun);
  return with_clouds(with_night(cloudless(options, sun), options, sun), options, sun);
}

}  // namespace render
