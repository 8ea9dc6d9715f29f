// The sun's shadow maps as shaders see them, one for each kind of occluders; SunShadow::bind() sets these. A variant
// says which kinds there are: VIRTUAL_OCCLUDERS, REAL_OCCLUDERS. What stands before the disc's parts is taken as
// independent from kind to kind.
#include "shadow/visibility.glsl"

const int kVirtual = 0;
const int kReal = 1;

uniform ShadowMap shadow_maps[2];
uniform highp sampler2DArrayShadow shadow_compared;
uniform highp sampler2DArray shadow_depth;  // the same, plain
uniform highp sampler2DArray shadow_bounds;
uniform float sun_disc_slope;  // tangent of the sun's angular radius

bool is_occluder(int kind) {
#ifdef VIRTUAL_OCCLUDERS
  if (kind == kVirtual) return true;
#endif
#ifdef REAL_OCCLUDERS
  if (kind == kReal) return true;
#endif
  return false;
}

BlockerSearch search_blockers(ShadowMap map, vec3 at, vec2 slope) {
  return blocker_search(shadow_bounds, map, at, slope, sun_disc_slope);
}

// Part of the sun's light that gets past the occluders of a kind to a surface point with that normal, facing the sun.
float visibility_at_surface(int kind, vec3 at_in_local, vec3 normal_in_local) {
  if (!is_occluder(kind)) return 1.0;
  ShadowMap map = shadow_maps[kind];
  vec3 at = (map.map_from_local * vec4(at_in_local, 1.0)).xyz;
  vec2 slope = receiver_slope(map.local_from_map, normal_in_local);
  return sun_visibility(shadow_compared, shadow_depth, map, search_blockers(map, at, slope), at, slope, sun_disc_slope);
}

// The same for a point of the medium, which has no slope to tell it from its own shadow.
float visibility_in_medium(int kind, vec3 at_in_local) {
  if (!is_occluder(kind)) return 1.0;
  ShadowMap map = shadow_maps[kind];
  vec3 at = (map.map_from_local * vec4(at_in_local, 1.0)).xyz;
  return sun_visibility(shadow_compared, shadow_depth, map, search_blockers(map, at, vec2(0.0)), at, vec2(0.0),
                        sun_disc_slope);
}

// Whether occluders of that kind may take some of it away: quick to tell, and never wrong when it says no.
bool may_be_shadowed(int kind, vec3 at_in_local, vec3 normal_in_local) {
  if (!is_occluder(kind)) return false;
  ShadowMap map = shadow_maps[kind];
  vec3 at = (map.map_from_local * vec4(at_in_local, 1.0)).xyz;
  return !search_blockers(map, at, receiver_slope(map.local_from_map, normal_in_local)).lit;
}
