#version 310 es
// Makes the march's map of both shadow maps: the depth of the first occluder on the light's way, in this map's own
// coordinates. Beside and before all occluders it is 1e9: behind nothing.
// variant: VIRTUAL_OCCLUDERS
// variant: REAL_OCCLUDERS
// variant: VIRTUAL_OCCLUDERS REAL_OCCLUDERS
precision highp float;

uniform vec2 texel;  // 1 / this map's size
uniform highp sampler2D virtual_depth;
uniform highp sampler2D real_depth;
// Coordinates of the shadow maps are scale * this map's + low: all look along the same axes.
uniform vec3 virtual_scale;
uniform vec3 virtual_low;
uniform vec3 real_scale;
uniform vec3 real_low;

layout(location = 0) out float depth;

float depth_here(highp sampler2D map, vec3 scale, vec3 low) {
  vec2 at = gl_FragCoord.xy * texel * scale.xy + low.xy;
  if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, vec2(1.0)))) return 1e9;
  float found = texelFetch(map, ivec2(at * vec2(textureSize(map, 0))), 0).r;
  return found < 1.0 ? (found - low.z) / scale.z : 1e9;  // an empty texel holds 1
}

void main() {
  depth = 1e9;
#ifdef VIRTUAL_OCCLUDERS
  depth = min(depth, depth_here(virtual_depth, virtual_scale, virtual_low));
#endif
#ifdef REAL_OCCLUDERS
  depth = min(depth, depth_here(real_depth, real_scale, real_low));
#endif
}
