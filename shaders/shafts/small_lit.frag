#version 310 es
// The lit part of the sunlight and the distance of each pixel of a small picture, marched.
// variant: DIVIDED
// variant: DIVIDED BOUNDED
// variant: DIVIDED FALLOFF
// variant: DIVIDED BOUNDED FALLOFF
// variant: NO_DEPTH
// variant: DIVIDED SUN_DISC VIRTUAL_CASTERS REAL_CASTERS BLOCKER_TAPS=8 FILTER_TAPS=16
precision highp float;

#define LINE_MARCH
#include "shafts/ray.glsl"
#include "shafts/view_depth.glsl"
#include "shafts/line_lit.glsl"

layout(location = 0) out vec2 lit_and_distance;

void main() {
  float z = view_distance(gl_FragCoord.xy);
  Ray ray = view_ray(gl_FragCoord.xy);
  vec2 stretch = medium_stretch(ray, z);
  Air air = air_along(ray, stretch.x);
  float all = sunlight_to(air, stretch.y);
  lit_and_distance = vec2(all > 0.0 ? lit_sunlight(0, ray, air, stretch, stretch, all).x / all : 1.0, z);
}
