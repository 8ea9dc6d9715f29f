#version 310 es
// Samples along the epipolar lines: each line a row, its places columns.
precision highp float;

#include "shafts/ray.glsl"
#include "shafts/view_depth.glsl"
#include "shafts/epipolar_lines.glsl"
#include "shafts/epipolar_visibility.glsl"

// Lit and dark sunlight; 1 / distance along the axis; 1: its end is lit, -1: no sample.
layout(location = 0) out vec4 sampled;

void main() {
  float row = floor(gl_FragCoord.y);
  float place_px = floor(gl_FragCoord.x) * sample_px;
  Line line = line_of_row(line_fan(), row);
  vec2 px = line.end + line.back * min(place_px, line.length_px);
  float z = distance_at(px * view_px_per_px, false);
  Ray ray = view_ray(px);
  vec2 segment = medium_segment(ray, z);
  MediumPath path = medium_along(ray, segment.x);
  vec2 part = cascade_of(ray, segment);
  float all = sunlight_in_cascade(path, part);
  bool beyond = place_px >= line.length_px + sample_px;  // the line has begun already
  if (beyond) segment = part = vec2(0.0);
  vec2 lit = lit_sunlight(int(row), ray, path, segment, part, all);
  sampled = vec4(lit.x, all - lit.x, 1.0 / z, beyond ? -1.0 : lit.y);
#ifdef CASCADE
  if (beyond || !ends_in_cascade(ray, segment)) sampled.w = beyond && is_first_cascade() ? -1.0 : 0.0;
  if (!is_first_cascade()) sampled.z = 0.0;
#endif
}
