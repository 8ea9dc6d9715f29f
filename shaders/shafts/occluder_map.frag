#version 310 es
// Makes the march's map of both shadow maps: the depth of the first occluder on the light's way, in this map's own
// coordinates. Beside and before all occluders it is 1e9: behind nothing.
// variant: VIRTUAL_OCCLUDERS
// variant: REAL_OCCLUDERS
// variant: VIRTUAL_OCCLUDERS REAL_OCCLUDERS
precision highp float;

uniform vec2 texel;  // 1 / this map's size
uniform highp sampler2DArray shadow_depth;
// Of each kind of occluders: coordinates of its shadow map are scale * this map's + low, since all look along the same
// axes.
uniform vec3 scales[2];
uniform vec3 lows[2];
uniform ivec2 layers;

layout(location = 0) out float depth;

float depth_here(int kind) {
  vec3 scale = scales[kind];
  vec3 low = lows[kind];
  vec2 at = gl_FragCoord.xy * texel * scale.xy + low.xy;
  if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, vec2(1.0)))) return 1e9;
  float found = texelFetch(shadow_depth, ivec3(at * vec2(textureSize(shadow_depth, 0).xy), layers[kind]), 0).r;
  return found < 1.0 ? (found - low.z) / scale.z : 1e9;  // an empty texel holds 1
}

void main() {
  depth = 1e9;
#ifdef VIRTUAL_OCCLUDERS
  depth = min(depth, depth_here(0));
#endif
#ifdef REAL_OCCLUDERS
  depth = min(depth, depth_here(1));
#endif
}
