#version 310 es
// Brute force: each pixel's ray is marched by itself. The weights are analytic, so that an unshadowed ray is exact.
precision highp float;

#include "shafts/ray.glsl"
#include "shafts/shading.glsl"
#include "shafts/view_depth.glsl"
#include "shafts/occluder_depth.glsl"
#include "shafts/steps.glsl"

layout(location = 0) out vec4 scattered;
layout(location = 1) out float distance_along_axis;

void main() {
  float z = view_distance(gl_FragCoord.xy);
  Ray ray = view_ray(gl_FragCoord.xy);
  vec2 segment = medium_segment(ray, z);
  MediumPath path = medium_along(ray, segment.x);
  distance_along_axis = is_first_cascade() ? z : 0.0;
  vec2 part = cascade_of(ray, segment);
  vec2 shadow = shadow_segment(ray.direction);
  vec2 marched = marched_segment(shadow, path, segment, part);
  float reach = min(shadow.y, part.y);
  float lit = march(ray, path, marched, reach).x;
  float all = sunlight_in_cascade(path, part);
  scattered = medium_light(ray, path, segment, sunlight_when(lit, path, part, marched, reach, all));
}
