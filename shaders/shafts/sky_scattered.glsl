#include "lib/sh9.glsl"

#include "shafts/medium_block.glsl"

vec3 sky_scattered(vec3 direction) {
  return max(sh9(sky_scatter_sh, direction), vec3(0.0));
}
