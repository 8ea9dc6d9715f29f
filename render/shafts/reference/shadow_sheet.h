#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "render/shafts/reference/occluder_tree.h"

namespace render {

// A view ray: metres from the eye, in the world.
struct ViewRay {
  glm::dvec3 origin_in_world{0.0};
  glm::dvec3 direction_in_world{0.0, 1.0, 0.0};  // unit
};

// A point from which light comes: a position in the world, or a unit direction towards it where it is so far away that
// its light is parallel.
struct LightOrigin {
  glm::dvec3 in_world{0.0, 0.0, 1.0};
  bool parallel = true;
};

// A part of a view ray, in metres from its origin, that light reaches, and what is left of it there (1: all).
struct LitSegment {
  double from_m = 0.0;
  double to_m = 0.0;
  glm::dvec3 through_rgb{1.0};
};

// Where on [from_m, to_m] of a view ray (to_m may be infinite) the light of one point arrives. View ray and light span
// a plane; what casts is where the plane cuts triangles, and the shadow of each such line on the ray is an interval
// with closed-form ends. So shadow boundaries are exact to double precision and none, however thin, is missed. Masked
// materials are cut out where the bilinear alpha of their texture falls below the cutoff (exactly, too); blended ones
// tint.
class ShadowSheet {
 public:
  explicit ShadowSheet(const OccluderTree& occluders) : occluders_(occluders) {}

  // In order along the ray, not touching unless their light differs. Shadows less than a hundred-millionth of a metre
  // (or of the distance) apart are one.
  std::vector<LitSegment> lit(const ViewRay& ray, const LightOrigin& light, double from_m, double to_m) const;

  // Distance of the first triangle that the ray meets in [from_m, to_m], masked ones where they are there; infinite
  // where it meets none.
  double first_hit_m(const ViewRay& ray, double from_m, double to_m) const;

 private:
  const OccluderTree& occluders_;
};

}  // namespace render
