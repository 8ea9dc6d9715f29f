#version 310 es
// Each pixel from the samples around it on the two epipolar lines to its sides, as far as they see the same surface and
// agree; every other pixel (depth edges, and steps of the light along a line) is computed by itself.
// variant: NO_DEPTH
// variant: BOUNDED
// variant: FALLOFF
// variant: BOUNDED FALLOFF
// variant: LINE_MARCH
// variant: LINE_MARCH BOUNDED
precision highp float;

#include "shafts/ray.glsl"
#include "shafts/shade.glsl"
#include "shafts/view_depth.glsl"
#include "shafts/lines.glsl"
#include "shafts/line_lit.glsl"

uniform highp sampler2D samples;   // line_samples.frag
uniform float places;              // samples on a line, less one
uniform int rows;                  // lines
uniform float tolerance;           // of the lit part, from one sample to the next
uniform float depth_tolerance;     // relative, of the distance

layout(location = 0) out vec4 scattered;
layout(location = 1) out float distance_along_axis;

// x: lit part; y: 1 where the two samples of one line tell it.
vec2 between(vec2 a, vec2 b, float part, float nearness) {
  vec2 middle = mix(a, b, part);
  // One over the distance is linear along a line on a flat surface.
  bool same_surface = abs(middle.y - nearness) <= depth_tolerance * max(middle.y, nearness);
  // Where both are fully lit or fully dark to farther away, the pixel is too.
  bool nearer = a.x == b.x && (a.x == 0.0 || a.x == 1.0) && nearness >= max(a.y, b.y);
  return vec2(middle.x, nearer || (same_surface && abs(a.x - b.x) <= tolerance) ? 1.0 : 0.0);
}

void main() {
  float z = view_distance(gl_FragCoord.xy);
  vec2 at = row_and_place(gl_FragCoord.xy);
  int row = clamp(int(at.x), 0, rows - 1);
  int next_row = min(row + 1, rows - 1);
  float place = at.y * places;
  int column = clamp(int(place), 0, int(places) - 1);
  float part = place - float(column);
  float nearness = 1.0 / z;
  vec2 one = between(texelFetch(samples, ivec2(column, row), 0).xy, texelFetch(samples, ivec2(column + 1, row), 0).xy,
                     part, nearness);
  vec2 other = between(texelFetch(samples, ivec2(column, next_row), 0).xy,
                       texelFetch(samples, ivec2(column + 1, next_row), 0).xy, part, nearness);
  float beside = at.x - float(row);
  vec2 weights = vec2(1.0 - beside, beside) * vec2(one.y, other.y);
  float weight = weights.x + weights.y;

  Ray ray = view_ray(gl_FragCoord.xy);
  vec2 stretch = medium_stretch(ray, z);
  Air air = air_along(ray, stretch.x);
  bool alone = weight < 0.3 && stretch.y > stretch.x;
  float lit = lit_share(alone, beside < 0.5 ? row : next_row, ray, air, stretch);
  if (!alone) lit = dot(weights, vec2(one.x, other.x)) / max(weight, 1e-6);
  distance_along_axis = z;
  scattered = shaded_air(ray, air, stretch, lit * sunlight_of(air, stretch));
}
