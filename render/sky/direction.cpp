#include "render/sky/direction.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace render {

glm::dvec3 above_horizon(const glm::dvec3& direction_in_world) {
  const glm::dvec3 unit = glm::normalize(direction_in_world);
  if (unit.z >= 0.0) return unit;
  const double horizontal = std::hypot(unit.x, unit.y);
  if (horizontal < 1e-12) return {0.0, 1.0, 0.0};
  return {unit.x / horizontal, unit.y / horizontal, 0.0};
}

Angle angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  const double cosine = std::clamp(glm::dot(a, b), -1.0, 1.0);
  return {std::acos(cosine), cosine};
}

glm::dvec3 daytime_sun_direction(const SunPosition& sun) {
  return above_horizon(sun.apparent_direction_in_world());
}

}  // namespace render
