#version 310 es
// Each pixel from the samples around it on the two epipolar lines to its sides, as far as they see the same surface and
// agree. ALONE: every other pixel (depth edges, and steps of the light along a line), computed by itself; the depth
// test keeps it to those. BOTH_SLICES: from the slices on both of its sides, not the nearest. Two passes, since
// software rasterisers run all code of a pass for all of its pixels.
precision highp float;

#include "shafts/ray.glsl"
#include "shafts/shading.glsl"
#include "shafts/view_depth.glsl"
#include "shafts/epipolar_lines.glsl"
#ifdef ALONE
#include "shafts/epipolar_visibility.glsl"
#else
uniform highp sampler2D pairs;   // epipolar_pairs.frag
uniform vec2 pairs_texel;        // 1 / size
uniform float depth_tolerance;   // relative, of the distance
#endif

layout(location = 0) out vec4 scattered;
layout(location = 1) out float distance_along_axis;

#ifdef ALONE
float sunlight_seen(float z, Ray ray, MediumPath path, vec2 segment, vec2 part, float all) {
#if defined(LINE_MARCH)
  return lit_sunlight(0, ray, path, segment, part, all).x;
#elif defined(BOTH_SLICES)
  float row = on_line(line_fan(), gl_FragCoord.xy).row;
  float first = floor(row);
  return mix(lit_sunlight(int(first), ray, path, segment, part, all).x,
             lit_sunlight(int(first) + 1, ray, path, segment, part, all).x, row - first);
#else
  // The nearest slice; halfway between two, neighbouring pixels take turns.
  vec2 turn = fract(0.5 * floor(gl_FragCoord.xy));
  float nearest = floor(on_line(line_fan(), gl_FragCoord.xy).row + (turn.x == turn.y ? 0.499 : 0.501));
  return lit_sunlight(int(nearest), ray, path, segment, part, all).x;
#endif
}
#else
// x: sunlight that gets past the occluders; y: 1 where the two samples of one line tell it.
vec2 between(vec4 pair, float along, float nearness, float all) {
  vec2 ends = abs(pair.zw);
  float spread = ends.y - ends.x;
  float margin = depth_tolerance * max(ends.x, ends.y);
  // One over the distance is linear along a line on a flat surface. At the edge of a nearer thing the pixel takes the
  // value of the side that it is on; what is kept never grows less with the distance, so between two distances it is
  // between the two values.
  float place = abs(spread) <= margin ? along : clamp((nearness - ends.x) / spread, 0.0, 1.0);
  bool in_range = nearness >= min(ends.x, ends.y) - margin && nearness <= max(ends.x, ends.y) + margin;
  // And where both are shadowed throughout, to farther away, the pixel is too.
  bool nearer = pair.z > 0.0 && pair.x == 0.0 && pair.y == 0.0 && nearness >= min(ends.x, ends.y);
  float kept = mix(pair.x, pair.y, place);
  return vec2(clamp(pair.z < 0.0 ? all - kept : kept, 0.0, all), in_range || nearer ? 1.0 : 0.0);
}

float sunlight_seen(float z, Ray ray, MediumPath path, vec2 segment, vec2 part, float all) {
  OnLine at = on_line(line_fan(), gl_FragCoord.xy);
  float row = floor(at.row);
  float column = floor(at.ahead_px / sample_px);
  float from_px = column * sample_px;
  float along = clamp((at.ahead_px - from_px) / max(min(from_px + sample_px, at.whole_px) - from_px, 1e-6), 0.0, 1.0);
  vec2 texel = (vec2(column, row) + 0.5) * pairs_texel;
  vec2 one = between(textureLod(pairs, texel, 0.0), along, 1.0 / z, all);
  vec2 other = between(textureLod(pairs, texel + vec2(0.0, pairs_texel.y), 0.0), along, 1.0 / z, all);
  float beside = at.row - row;
  vec2 weights = vec2(1.0 - beside, beside) * vec2(one.y, other.y);
  float weight = weights.x + weights.y;
  if (weight < 0.3 && segment.y > segment.x) discard;
  return dot(weights, vec2(one.x, other.x)) / max(weight, 1e-6);
}
#endif

void main() {
  float z = view_distance(gl_FragCoord.xy);
  Ray ray = view_ray(gl_FragCoord.xy);
  vec2 segment = medium_segment(ray, z);
  MediumPath path = medium_along(ray, segment.x);
  distance_along_axis = is_first_cascade() ? z : 0.0;
  vec2 part = cascade_of(ray, segment);
  scattered = medium_light(ray, path, segment, sunlight_seen(z, ray, path, segment, part, sunlight_in_cascade(path, part)));
}
