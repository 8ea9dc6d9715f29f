#version 310 es
#pragma skyshaft large_primitives
// The places along all epipolar lines, or what lies between each two: rectangles as high as 64 lines and as wide as
// the longest of them. Each line is a row of the viewport, its places columns.
#include "lib/quad.glsl"
#include "shafts/epipolar_lines.glsl"

uniform vec2 half_size_px;  // of the viewport
uniform float more;         // places than whole samples fit in a line: 2; between them: 1

void main() {
  const int kRows = 64;  // draw_row_groups()
  int group = gl_VertexID / 6;
  ivec2 corner = quad_corner(gl_VertexID);
  int first = group * kRows;
  int last = min(first + kRows, int(last_row) + 1);
  float longest_px = 0.0;
  for (int row = first; row < last; ++row) longest_px = max(longest_px, line_of_row(line_fan(), float(row)).length_px);
  float width = ceil(longest_px / sample_px) + more;
  vec2 px = vec2(corner.x != 0 ? width : 0.0, float(corner.y != 0 ? last : first));
  gl_Position = vec4(px / half_size_px - 1.0, 0.0, 1.0);
}
