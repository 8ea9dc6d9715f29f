#version 310 es
// Samples along the epipolar lines: each line a row, its places columns.
// variant: NO_DEPTH
// variant: BOUNDED
// variant: FALLOFF
// variant: BOUNDED FALLOFF
// variant: LINE_MARCH
// variant: LINE_MARCH BOUNDED
// variant: LINE_MARCH SUN_DISC REAL_CASTERS BLOCKER_TAPS=8 FILTER_TAPS=16
precision highp float;

#include "shafts/ray.glsl"
#include "shafts/view_depth.glsl"
#include "shafts/lines.glsl"
#include "shafts/line_lit.glsl"

uniform float places;  // samples on a line, less one

layout(location = 0) out vec2 lit_and_nearness;  // lit part of the sunlight; 1 / distance along the axis

void main() {
  int row = int(gl_FragCoord.y);
  Line line = line_of_row(row);
  vec2 px = mix(line.start, line.end, (gl_FragCoord.x - 0.5) / places);
  float z = distance_at(px * view_px_per_px, false);
  Ray ray = view_ray(px);
  vec2 stretch = medium_stretch(ray, z);
  Air air = air_along(ray, stretch.x);
  lit_and_nearness = vec2(lit_share(row, ray, air, stretch), 1.0 / z);
}
