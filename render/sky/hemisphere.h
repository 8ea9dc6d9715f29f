#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "render/sky/sky_model.h"

namespace render {

// A direction with its share of solid angle.
struct SolidAngleSample {
  glm::dvec3 direction_in_world;
  double solid_angle_sr;
};

// Gauss-Legendre rings in sin(elevation) by equal steps in azimuth over the upper half: 32 x 64 samples, exact for
// polynomials of degree 63. The solid angles sum to 2 pi.
const std::vector<SolidAngleSample>& upper_hemisphere();

// Lux of level ground under `sky`, linear Rec. 709.
glm::dvec3 horizontal_illuminance(const SkyModel& sky);

}  // namespace render
