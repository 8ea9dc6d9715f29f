#pragma once

#include <chrono>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "render/sky/sky_model.h"
#include "render/sun/sun.h"

namespace render {

// A plane that light falls on: where it faces, clockwise from north, and how far it leans from level (90 degrees: a
// wall).
struct LitPlane {
  double azimuth_rad = 0.0;
  double tilt_rad = 0.0;

  glm::dvec3 normal_in_world() const;
};

// A stretch of the sun's way and what is asked of it.
struct AverageRequest {
  Place place;
  UtcTime first;
  UtcTime last;
  std::chrono::microseconds step{0};  // above 0
  SunTier tier = SunTier::Precise;
  Weather weather;
  SkyOptions sky;
  LitPlane plane;
  double bin_deg = 15.0;  // divides 90
};

// A cell of azimuth and elevation: what comes from it on average.
struct DirectionBin {
  double azimuth_rad = 0.0;  // of its middle
  double elevation_rad = 0.0;
  double solid_angle_sr = 0.0;
  glm::dvec3 sky_luminance_rgb{0.0};    // cd/m2, without the sun
  glm::dvec3 sun_illuminance_rgb{0.0};  // lux facing the sun, while it stands in the cell
  double plane_sky_lux = 0.0;           // what of both falls on the plane
  double plane_sun_lux = 0.0;
};

struct AverageLight {
  AverageRequest request;
  int instants = 0;
  double hours = 0.0;
  std::vector<DirectionBin> bins;       // rows of azimuth from north clockwise, the lowest row first
  glm::dvec3 sky_illuminance_rgb{0.0};  // lux of the plane; the bins' parts sum to it
  glm::dvec3 sun_illuminance_rgb{0.0};
  std::vector<std::string> beyond_range;  // what beyond_range() says of any of the instants, each once
};

// Mean over time, by the trapezoid rule over the instants from first to last: the average solution over a trajectory
// of the natural-light paper, section 3.1. Throws as daylight() does.
AverageLight average_light(const AverageRequest& request);

}  // namespace render
