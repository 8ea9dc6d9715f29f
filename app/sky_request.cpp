#include "app/sky_request.h"

#include <cmath>

#include "app/error.h"
#include "render/sky/direction.h"
#include "render/sky/moon.h"

namespace app {

glm::dvec3 view_direction(const ViewRequest& view) {
  const double horizontal = std::cos(view.elevation_rad);
  return {std::sin(view.azimuth_rad) * horizontal, std::cos(view.azimuth_rad) * horizontal,
          std::sin(view.elevation_rad)};
}

double sun_angle_rad(const SkyAnswer& answer, const glm::dvec3& direction_in_world) {
  return render::angle_between(direction_in_world, answer.sun.apparent_direction_in_world()).radians;
}

SkyAnswer answer(const SunRequest& request, render::SkyOptions options) {
  SkyAnswer result;
  if (request.place && request.time) {
    result.sun = render::sun_position(*request.place, *request.time);
    options.moon = render::moon_position(*request.place, *request.time);
    options.clouds.time_s = static_cast<double>(request.time->time_since_epoch().count() % 86'400'000'000) * 1e-6;
  } else if (!request.elevation_rad) {
    throw UsageError("the sun's place is not known\ngive --at and --time, or --sun AZIMUTH,ELEVATION");
  }
  if (request.azimuth_rad) result.sun.azimuth_rad = *request.azimuth_rad;
  if (request.elevation_rad) result.sun.elevation_rad = result.sun.apparent_elevation_rad = *request.elevation_rad;
  result.sky = render::make_sky(options, result.sun);
  const double height_m = request.place ? request.place->height_m : 0.0;
  result.sun_illuminance_rgb = render::sun_light(result.sun, options.turbidity, height_m).illuminance_rgb *
                               result.sky->transmittance(result.sun.apparent_direction_in_world());
  return result;
}

}  // namespace app
