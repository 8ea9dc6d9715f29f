#include "render/sky/spherical_triangle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace render {

double SphericalTriangle::solid_angle_sr() const {
  const auto& [a, b, c] = corner;
  const double triple = glm::dot(a, glm::cross(b, c));
  return 2.0 * std::abs(std::atan2(triple, 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a)));
}

glm::dvec3 SphericalTriangle::moment_sr() const {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 normal = glm::cross(corner[i], corner[(i + 1) % 3]);
    const double sine = glm::length(normal);
    if (sine > 1e-15) sum += normal / sine * std::atan2(sine, glm::dot(corner[i], corner[(i + 1) % 3]));
  }
  return 0.5 * sum;
}

glm::dvec3 SphericalTriangle::centroid() const {
  return glm::normalize(corner[0] + corner[1] + corner[2]);
}

std::array<SphericalTriangle, 4> SphericalTriangle::quarters() const {
  const auto& [a, b, c] = corner;
  const glm::dvec3 ab = glm::normalize(a + b);
  const glm::dvec3 bc = glm::normalize(b + c);
  const glm::dvec3 ca = glm::normalize(c + a);
  return {{{{a, ab, ca}}, {{ab, b, bc}}, {{ca, bc, c}}, {{ab, bc, ca}}}};
}

}  // namespace render
