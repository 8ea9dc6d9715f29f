#version 310 es
// The light of each pixel: with nothing that shadows it, or (LIT) with the part of the sun's light given.
precision highp float;

#include "shafts/ray.glsl"
#include "shafts/shading.glsl"
#ifdef LIT
#include "shafts/tile_average.glsl"
uniform highp sampler2D lit_and_distance;  // averaged along rows already
#else
#include "shafts/view_depth.glsl"
#endif

layout(location = 0) out vec4 scattered;
layout(location = 1) out float distance_along_axis;

void main() {
#ifdef LIT
  vec2 found = tile_average(lit_and_distance, ivec2(gl_FragCoord.xy), ivec2(0, 1));
  float lit = found.x;
  float z = found.y;
#else
  float lit = 1.0;
  float z = view_distance(gl_FragCoord.xy);
#endif
  Ray ray = view_ray(gl_FragCoord.xy);
  vec2 segment = medium_segment(ray, z);
  MediumPath path = medium_along(ray, segment.x);
  distance_along_axis = z;
  scattered = medium_light(ray, path, segment, lit * sunlight_to(path, segment.y));
}
