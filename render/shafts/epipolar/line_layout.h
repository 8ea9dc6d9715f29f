#pragma once

#include <glm/glm.hpp>

#include "render/gl/program.h"
#include "render/shafts/shaft_technique.h"

namespace render {

// Where the epipolar lines of a picture lie, and how densely they are sampled (shaders/shafts/epipolar_lines.glsl).
struct LineLayout {
  glm::dvec3 sun_in_px{0.0};  // the sun's direction projected, homogeneous, z >= 0; behind the eye: negated
  glm::ivec2 picture_px{0};
  glm::ivec4 side_first{0};  // row of the first line that ends on the left, right, top, bottom border
  glm::ivec4 side_count{0};
  int rows = 0;
  double sample_px = 1.0;  // from sample to sample, counted from a line's end; the last lies where the line begins
  int samples = 2;         // on the longest line

  // Where the line of that row ends on the picture's border, pixels.
  glm::dvec2 end_px(int row) const;

  void set(const gl::Program& program) const;
};

// Lines that end `line_px` pixels apart on the borders that face away from the sun (farther where there would be too
// many for a texture's rows), with samples `sample_px` apart, in a picture of that size.
LineLayout lay_out_lines(const ShaftInputs& inputs, const glm::ivec2& picture_px, double line_px, double sample_px);

}  // namespace render
