#pragma once

#include <glm/vec3.hpp>

#include "render/sun/sun.h"

namespace render {

// The unit vector of `direction_in_world`; what lies below the horizon is moved up to it, straight down to north.
glm::dvec3 above_horizon(const glm::dvec3& direction_in_world);

// The angle between two unit vectors, rounding errors beyond +-1 clamped away.
struct Angle {
  double radians;
  double cosine;
};
Angle angle_between(const glm::dvec3& a, const glm::dvec3& b);

// Where a model that knows the day alone takes the sun to be: its apparent direction, not below the horizon.
glm::dvec3 daytime_sun_direction(const SunPosition& sun);

}  // namespace render
