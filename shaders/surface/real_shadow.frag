#version 310 es
// What virtual things take away from the light on a real surface (M of docs/shafts.md, "Composite").
// SOUGHT: leaves nothing, and only where virtual things may take anything away from what is seen of the surface.
precision highp float;

#include "shadow/shadow_maps.glsl"
#include "lib/sh9.glsl"
#ifdef TRANSLUCENT
#include "shadow/translucent.glsl"
#endif

uniform vec3 sun_direction_in_local;
uniform vec3 sun_illuminance;      // pre-exposed
uniform vec3 sky_irradiance_sh[9];  // pre-exposed, cosine-convolved
uniform highp sampler2D added;      // a: part of the pixel that virtual things leave uncovered

in vec3 v_position;
in vec3 v_normal;
layout(location = 0) out vec4 multiplier;

vec3 light_left(vec3 normal) {
  float n_s = max(dot(normal, sun_direction_in_local), 0.0);
  vec3 seen = vec3(visibility_at_surface(kVirtual, v_position, normal));
#ifdef TRANSLUCENT
  seen *= light_through_translucent(v_position);
#endif
  if (all(greaterThanEqual(seen, vec3(1.0))) || n_s <= 0.0) return vec3(1.0);
  vec3 sun = sun_illuminance * (n_s * visibility_at_surface(kReal, v_position, normal));
  if (dot(sun, vec3(1.0)) <= 0.0) return vec3(1.0);
  vec3 sky = max(sh9(sky_irradiance_sh, normal), vec3(0.0));
  return (sun * seen + sky) / max(sun + sky, vec3(1e-20));
}

void main() {
  vec3 normal = normalize(v_normal);
  if (dot(normal, v_position) > 0.0) normal = -normal;  // the side that is seen
#ifdef SOUGHT
  bool seen = texelFetch(added, ivec2(gl_FragCoord.xy), 0).a > 0.0;
  bool less = may_be_shadowed(kVirtual, v_position, normal);
#ifdef TRANSLUCENT
  less = less || light_through_translucent(v_position) != vec3(1.0);
#endif
  if (!seen || dot(normal, sun_direction_in_local) <= 0.0 || !less) discard;
  multiplier = vec4(1.0);
#else
  multiplier = vec4(light_left(normal), 1.0);
#endif
}
