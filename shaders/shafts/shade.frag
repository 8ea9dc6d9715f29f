#version 310 es
// Light that the medium sends to the eye, and what it lets through: closed forms, times the visible part of the sun
// where something casts shafts.
// variant: NO_DEPTH
// variant: BOUNDED
// variant: MARCHED
// variant: MARCHED BOUNDED
precision highp float;

#include "shafts/ray.glsl"
#ifdef MARCHED
#include "shafts/tile_average.glsl"
uniform highp sampler2D lit_and_distance;  // averaged along rows already
#else
#include "shafts/view_depth.glsl"
#endif
#include "scene/sh9.glsl"

uniform vec3 sun_direction;       // local frame
uniform vec3 sun_scattered;       // illuminance * albedo, pre-exposed
uniform vec3 sky_scatter_sh[9];   // sky radiance * phase moments * albedo, pre-exposed
uniform int phase_kind;
uniform float phase_g;

layout(location = 0) out vec4 scattered;
layout(location = 1) out float distance_along_axis;

void main() {
#ifdef MARCHED
  vec2 marched = tile_average(lit_and_distance, ivec2(gl_FragCoord.xy), ivec2(0, 1));
  float lit = marched.x;
  float z = marched.y;
#else
  float lit = 1.0;
  float z = view_distance(gl_FragCoord.xy);
#endif
  Ray ray = view_ray(gl_FragCoord.xy);
  vec2 stretch = medium_stretch(ray, z);
  distance_along_axis = z;
  if (stretch.y <= stretch.x) {
    scattered = vec4(0.0, 0.0, 0.0, 1.0);
    return;
  }
  float depth = extinction * (stretch.y - stretch.x);
  float p = phase(phase_kind, phase_g, clamp(dot(ray.direction, sun_direction), -1.0, 1.0));
  vec3 light = sun_scattered * (p * lit * sunlit_fraction(ray, stretch, stretch.x));
  light += max(sh9(sky_scatter_sh, ray.direction), vec3(0.0)) * scattered_fraction(depth);
  scattered = vec4(min(light, vec3(60000.0)), exp(-depth));  // half floats end at 65504
}
