#version 310 es
#pragma skyshaft large_primitives
// The cells of all slices, and few more: rectangles as high as 64 slices and as wide as the longest of them has
// blocks of 16 cells. Each slice is a row of the viewport, from its left edge on.
#include "lib/quad.glsl"

uniform highp sampler2D slices;  // render/shafts/epipolar/slice_trees.h
uniform int rows;
uniform float pixels_a_block;
uniform vec2 half_size_px;  // of the viewport

void main() {
  const int kRows = 64;  // draw_row_groups()
  int group = gl_VertexID / 6;
  ivec2 corner = quad_corner(gl_VertexID);
  int first = group * kRows;
  int last = min(first + kRows, rows);
  float longest = 0.0;
  for (int row = first; row < last; ++row) longest = max(longest, texelFetch(slices, ivec2(0, row), 0).w);
  float width = ceil(longest / 16.0) * pixels_a_block;
  vec2 px = vec2(corner.x != 0 ? width : 0.0, float(corner.y != 0 ? last : first));
  gl_Position = vec4(px / half_size_px - 1.0, 0.0, 1.0);
}
