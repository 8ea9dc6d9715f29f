#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/daylight/daylight.h"

namespace app {

// Where the sun stands: by place and time, or given outright.
struct SunRequest {
  std::optional<render::Place> place;
  std::optional<render::UtcTime> time;
  std::optional<double> azimuth_rad;    // replaces the computed azimuth
  std::optional<double> elevation_rad;  // replaces the computed elevation, geometric and apparent
  render::SunTier tier = render::SunTier::Precise;
  render::Weather weather;
};

// A direction that was asked for, radians.
struct ViewRequest {
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
};
glm::dvec3 view_direction(const ViewRequest& view);

// Angle between a unit direction and the sun as it is seen, radians.
double sun_angle_rad(const render::Daylight& light, const glm::dvec3& direction_in_world);

// Throws UsageError where neither place and time nor an elevation is known. The moon is put in when place and time are.
// What lies outside the model's range is logged, each kind once.
render::Daylight answer(const SunRequest& request, const render::SkyOptions& options);

// Logs each message once in the life of the program.
void warn_once(const std::vector<std::string>& messages);

}  // namespace app
