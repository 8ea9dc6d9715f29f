#version 310 es
// Each pixel from the samples around it on the two epipolar lines to its sides, as far as they see the same surface and
// agree. ALONE: every other pixel (depth edges, and steps of the light along a line), computed by itself; the depth
// test keeps it to those. Two passes, since software rasterisers run all code of a pass for all of its pixels.
// variant: NO_DEPTH
// variant: DIVIDED BOUNDED
// variant: FALLOFF
// variant: BOUNDED FALLOFF
// variant: ALONE
// variant: ALONE BOUNDED FALLOFF
// variant: ALONE LINE_MARCH
// variant: ALONE LINE_MARCH BOUNDED
// variant: ALONE LINE_MARCH SUN_DISC REAL_CASTERS BLOCKER_TAPS=8 FILTER_TAPS=16
precision highp float;

#include "shafts/ray.glsl"
#include "shafts/shade.glsl"
#include "shafts/view_depth.glsl"
#include "shafts/lines.glsl"
#ifdef ALONE
#include "shafts/line_lit.glsl"
#else
uniform highp sampler2D samples;  // line_samples.frag
uniform vec2 samples_texel;       // 1 / size
uniform float places;             // samples on a line, less one
uniform int rows;                 // lines
uniform float tolerance;          // of the lit part, from one sample to the next
uniform float depth_tolerance;    // relative, of the distance
#endif

layout(location = 0) out vec4 scattered;
layout(location = 1) out float distance_along_axis;

#ifdef ALONE
float lit_part(float z, Ray ray, Air air, vec2 stretch) {
  return lit_share(int(row_and_place(gl_FragCoord.xy).x + 0.5), ray, air, stretch);
}
#else
// x: lit part; y: 1 where the two samples of one line tell it.
vec2 between(vec2 lit, vec2 nearness, float part, float own_nearness) {
  float middle = mix(nearness.x, nearness.y, part);
  // One over the distance is linear along a line on a flat surface.
  bool same_surface = abs(middle - own_nearness) <= depth_tolerance * max(middle, own_nearness);
  // Where both are fully lit or fully dark to farther away, the pixel is too.
  bool nearer = lit.x == lit.y && (lit.x == 0.0 || lit.x == 1.0) && own_nearness >= max(nearness.x, nearness.y);
  return vec2(mix(lit.x, lit.y, part), nearer || (same_surface && abs(lit.x - lit.y) <= tolerance) ? 1.0 : 0.0);
}

float lit_part(float z, Ray ray, Air air, vec2 stretch) {
  vec2 at = row_and_place(gl_FragCoord.xy);
  float row = clamp(floor(at.x), 0.0, float(rows) - 1.0);
  float place = at.y * places;
  float column = clamp(floor(place), 0.0, places - 1.0);
  vec2 corner = (vec2(column, row) + 1.0) * samples_texel;
  vec4 lit = textureGather(samples, corner, 0);  // of (0, 1), (1, 1), (1, 0), (0, 0)
  vec4 nearness = textureGather(samples, corner, 1);
  vec2 one = between(lit.wz, nearness.wz, place - column, 1.0 / z);
  vec2 other = between(lit.xy, nearness.xy, place - column, 1.0 / z);
  float beside = at.x - row;
  vec2 weights = vec2(1.0 - beside, beside) * vec2(one.y, other.y);
  float weight = weights.x + weights.y;
  if (weight < 0.3 && stretch.y > stretch.x) discard;
  return dot(weights, vec2(one.x, other.x)) / max(weight, 1e-6);
}
#endif

void main() {
  float z = view_distance(gl_FragCoord.xy);
  Ray ray = view_ray(gl_FragCoord.xy);
  vec2 stretch = medium_stretch(ray, z);
  Air air = air_along(ray, stretch.x);
  distance_along_axis = z;
  scattered = shaded_air(ray, air, stretch, lit_part(z, ray, air, stretch) * sunlight_of(air, stretch));
}
