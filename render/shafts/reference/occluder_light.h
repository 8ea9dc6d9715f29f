#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "render/shafts/reference/occluder_tree.h"

namespace render {

// A part of a straight line across a triangle, from 0 to 1 along it, and what it lets through of light (0: nothing).
struct LetThrough {
  double from = 0.0;
  double to = 1.0;
  glm::dvec3 rgb{0.0};
};

// What a triangle lets through along the line between two texture coordinates, in pieces that cover [0, 1].
void let_through(const OccluderTriangle& triangle, const glm::dvec2& uv_from, const glm::dvec2& uv_to,
                 std::vector<LetThrough>& pieces);

}  // namespace render
