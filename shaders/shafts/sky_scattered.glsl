#include "surface/sh9.glsl"

uniform vec3 sky_scatter_sh[9];  // sky radiance * phase moments * albedo * gain of the fog, pre-exposed

vec3 sky_scattered(vec3 direction) {
  return max(sh9(sky_scatter_sh, direction), vec3(0.0));
}
