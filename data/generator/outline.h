#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "render/scene/model.h"

namespace generator {

// A closed outline in a plane, counter-clockwise; the normal of each point is what the light sees there. Two points in
// one place with different normals make a hard edge.
struct OutlinePoint {
  glm::vec2 position;
  glm::vec2 normal;
  float across;  // metres around the outline, for the texture
};
using Outline = std::vector<OutlinePoint>;

// A rectangle about the origin with its corners cut by `chamfer`; the cuts blend between their neighbours' normals, so
// that they catch the light like a planed edge. `across` runs from -width / 2 to width / 2 over one face and back over
// the next: all four share one strip of the texture and meet without a jump.
Outline chamfered_rectangle(const glm::vec2& size, float chamfer);

// Points joined in order, with smooth normals where the direction turns by less than 40 degrees; `across` is the arc
// length from the first.
Outline smooth_outline(const std::vector<glm::vec2>& points);

// Triangles of a simple polygon, counter-clockwise, by cutting off ears.
std::vector<glm::uvec3> triangulate(const std::vector<glm::vec2>& polygon);

// Right-handed frame of a solid: columns across_x, across_y, along, and the origin.
struct Frame {
  glm::vec3 origin{0.0F};
  glm::mat3 axes{1.0F};
  glm::vec3 point(const glm::vec3& v) const { return origin + axes * v; }
};

// The texture coordinates of an extruded solid's two kinds of faces.
struct Mapping {
  // (`across`, distance along) in metres -> uv
  glm::mat3 uv_from_side{1.0F};
  // (x, y) of the outline in metres -> uv
  glm::mat3 uv_from_cap{1.0F};
};

// Adds the solid between z = -length / 2 and z = length / 2 of `frame`, whose two end faces are bevelled by `bevel`.
void extrude(render::Mesh& mesh, const Outline& outline, float length, float bevel, const Frame& frame,
             const Mapping& mapping);

}  // namespace generator
