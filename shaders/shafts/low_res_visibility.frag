#version 310 es
// The lit part of the sunlight and the distance of each pixel of a small picture, marched.
precision highp float;

#define LINE_MARCH
#include "shafts/ray.glsl"
#include "shafts/view_depth.glsl"
#include "shafts/epipolar_visibility.glsl"

layout(location = 0) out vec2 lit_and_distance;

void main() {
  float z = view_distance(gl_FragCoord.xy);
  Ray ray = view_ray(gl_FragCoord.xy);
  vec2 segment = medium_segment(ray, z);
  MediumPath path = medium_along(ray, segment.x);
  float all = sunlight_to(path, segment.y);
  lit_and_distance = vec2(all > 0.0 ? lit_sunlight(0, ray, path, segment, segment, all).x / all : 1.0, z);
}
