// The shadow maps as shaders see them; SunShadow::bind() and bind_bounds() set these. With REAL_OCCLUDERS there are two.
#include "shadow/visibility.glsl"

uniform highp sampler2DShadow virtual_compared;
uniform highp sampler2D virtual_depth;
uniform mat4 virtual_map_from_local;
uniform mat3 virtual_local_from_map;
uniform vec3 virtual_metres_per_unit;
uniform float virtual_texel;
uniform highp sampler2D virtual_bounds;
uniform float virtual_reach;
#ifdef REAL_OCCLUDERS
uniform highp sampler2DShadow real_compared;
uniform highp sampler2D real_depth;
uniform mat4 real_map_from_local;
uniform mat3 real_local_from_map;
uniform vec3 real_metres_per_unit;
uniform float real_texel;
uniform highp sampler2D real_bounds;
uniform float real_reach;
#endif
uniform float sun_disc_slope;  // tangent of the sun's angular radius

#ifdef VIRTUAL_OCCLUDERS
BlockerSearch virtual_search(vec3 at, vec2 slope) {
  return blocker_search(virtual_bounds, virtual_reach, at, slope, virtual_texel, virtual_metres_per_unit,
                        sun_disc_slope);
}
#endif

// Part of the sun's light that gets past virtual things to a surface point with that normal, facing the sun.
float virtual_visibility(vec3 at_in_local, vec3 normal_in_local) {
#ifdef VIRTUAL_OCCLUDERS
  vec3 at = (virtual_map_from_local * vec4(at_in_local, 1.0)).xyz;
  vec2 slope = receiver_slope(virtual_local_from_map, normal_in_local);
  return sun_visibility(virtual_compared, virtual_depth, virtual_search(at, slope), at, slope, virtual_texel,
                        virtual_metres_per_unit, sun_disc_slope);
#else
  return 1.0;
#endif
}

// The same for a point of the medium, which has no slope to tell it from its own shade.
float virtual_visibility_in_medium(vec3 at_in_local) {
#ifdef VIRTUAL_OCCLUDERS
  vec3 at = (virtual_map_from_local * vec4(at_in_local, 1.0)).xyz;
  return sun_visibility(virtual_compared, virtual_depth, virtual_search(at, vec2(0.0)), at, vec2(0.0), virtual_texel,
                        virtual_metres_per_unit, sun_disc_slope);
#else
  return 1.0;
#endif
}

// Whether virtual things may take some of it away: quick to tell, and never wrong when it says no.
bool may_be_shadowed_by_virtual(vec3 at_in_local, vec3 normal_in_local) {
#ifdef VIRTUAL_OCCLUDERS
  vec3 at = (virtual_map_from_local * vec4(at_in_local, 1.0)).xyz;
  return !virtual_search(at, receiver_slope(virtual_local_from_map, normal_in_local)).lit;
#else
  return false;
#endif
}

// And past real things.
float real_visibility(vec3 at_in_local, vec3 normal_in_local) {
#ifdef REAL_OCCLUDERS
  vec3 at = (real_map_from_local * vec4(at_in_local, 1.0)).xyz;
  vec2 slope = receiver_slope(real_local_from_map, normal_in_local);
  BlockerSearch search = blocker_search(real_bounds, real_reach, at, slope, real_texel, real_metres_per_unit,
                                        sun_disc_slope);
  return sun_visibility(real_compared, real_depth, search, at, slope, real_texel, real_metres_per_unit, sun_disc_slope);
#else
  return 1.0;
#endif
}

float real_visibility_in_medium(vec3 at_in_local) {
#ifdef REAL_OCCLUDERS
  vec3 at = (real_map_from_local * vec4(at_in_local, 1.0)).xyz;
  BlockerSearch search = blocker_search(real_bounds, real_reach, at, vec2(0.0), real_texel, real_metres_per_unit,
                                        sun_disc_slope);
  return sun_visibility(real_compared, real_depth, search, at, vec2(0.0), real_texel, real_metres_per_unit,
                        sun_disc_slope);
#else
  return 1.0;
#endif
}
