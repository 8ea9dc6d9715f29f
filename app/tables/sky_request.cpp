#include "app/tables/sky_request.h"

#include <spdlog/spdlog.h>

#include <cmath>
#include <set>
#include <string>

#include "app/error.h"
#include "render/sky/direction.h"

namespace app {

glm::dvec3 view_direction(const ViewRequest& view) {
  const double horizontal = std::cos(view.elevation_rad);
  return {std::sin(view.azimuth_rad) * horizontal, std::cos(view.azimuth_rad) * horizontal,
          std::sin(view.elevation_rad)};
}

double sun_angle_rad(const render::Daylight& light, const glm::dvec3& direction_in_world) {
  return render::angle_between(direction_in_world, light.sun.apparent_direction_in_world()).radians;
}

void warn_once(const std::vector<std::string>& messages) {
  static std::set<std::string> said;
  for (const std::string& message : messages) {
    if (said.insert(message).second) spdlog::warn("{}", message);
  }
}

render::Daylight answer(const SunRequest& request, const render::SkyOptions& options) {
  const bool known = request.place && request.time;
  if (!known && !request.elevation_rad) {
    throw UsageError("the sun's place is not known\ngive --at and --time, or --sun AZIMUTH,ELEVATION");
  }
  // Without a place the time of day says nothing, of the clouds neither.
  const render::Daylight light =
      render::daylight({.place = request.place,
                        .time = known ? request.time : std::nullopt,
                        .sun = {.azimuth_rad = request.azimuth_rad, .elevation_rad = request.elevation_rad},
                        .tier = request.tier,
                        .weather = request.weather,
                        .sky = options});
  warn_once(render::beyond_range(light));
  return light;
}

}  // namespace app
