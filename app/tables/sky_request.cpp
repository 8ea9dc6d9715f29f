#include "app/tables/sky_request.h"

#include <spdlog/spdlog.h>

#include <cmath>
#include <set>
#include <string>

#include "app/error.h"
#include "render/sky/direction.h"
#include "render/sky/moon.h"
#include "render/sun/spectrum.h"

namespace app {

glm::dvec3 view_direction(const ViewRequest& view) {
  const double horizontal = std::cos(view.elevation_rad);
  return {std::sin(view.azimuth_rad) * horizontal, std::cos(view.azimuth_rad) * horizontal,
          std::sin(view.elevation_rad)};
}

double sun_angle_rad(const SkyAnswer& answer, const glm::dvec3& direction_in_world) {
  return render::angle_between(direction_in_world, answer.sun.apparent_direction_in_world()).radians;
}

namespace {

void warn_once(const render::SkyOptions& options, const render::SunPosition& sun) {
  static std::set<std::string> said;
  for (const std::string& message : render::beyond_range(options, sun)) {
    if (said.insert(message).second) spdlog::warn("{}", message);
  }
}

// By measured or given conditions where there are any, coloured and dimmed at the horizon as by the air's turbidity.
glm::dvec3 sun_illuminance_rgb(const render::SkyOptions& options, const render::SunPosition& sun) {
  const glm::dvec3 by_air = render::sun_light(sun, options.turbidity, options.height_m).illuminance_rgb;
  const std::optional<double> given_lux = options.model == "perez" ? render::given_sun_lux(options, sun) : std::nullopt;
  const double lux = render::luminance(by_air);
  if (!given_lux || lux <= 0.0) return by_air;
  return by_air * (*given_lux * render::sun_light(sun, options.turbidity).visible_disc_fraction / lux);
}

}  // namespace

SkyAnswer answer(const SunRequest& request, render::SkyOptions options) {
  SkyAnswer result;
  if (request.place) options.height_m = request.place->height_m;
  if (request.place && request.time) {
    result.sun = render::sun_position(*request.place, *request.time, request.tier, request.weather);
    options.moon = render::moon_position(*request.place, *request.time, request.weather);
    options.clouds.time_s = static_cast<double>(request.time->time_since_epoch().count() % 86'400'000'000) * 1e-6;
  } else if (!request.elevation_rad) {
    throw UsageError("the sun's place is not known\ngive --at and --time, or --sun AZIMUTH,ELEVATION");
  }
  if (request.azimuth_rad) result.sun.azimuth_rad = *request.azimuth_rad;
  if (request.elevation_rad) result.sun.elevation_rad = result.sun.apparent_elevation_rad = *request.elevation_rad;
  warn_once(options, result.sun);
  result.sky = render::make_sky(options, result.sun);
  result.sun_illuminance_rgb =
      sun_illuminance_rgb(options, result.sun) * result.sky->transmittance(result.sun.apparent_direction_in_world());
  return result;
}

}  // namespace app
