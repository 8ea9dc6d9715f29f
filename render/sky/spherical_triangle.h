#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace render {

// A triangle on the unit sphere, bounded by great circles; corners counter-clockwise seen from outside.
struct SphericalTriangle {
  std::array<glm::dvec3, 3> corner;

  double solid_angle_sr() const;  // Van Oosterom & Strackee 1983
  // The integral of the direction over the triangle (Lambert 1760): its dot product with a normal is the projected
  // solid angle, exactly, where the triangle lies on one side of the plane.
  glm::dvec3 moment_sr() const;
  glm::dvec3 centroid() const;
  // Cut through the middles of the sides: three corners, then the middle.
  std::array<SphericalTriangle, 4> quarters() const;
};

}  // namespace render
