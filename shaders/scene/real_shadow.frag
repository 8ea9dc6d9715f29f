#version 310 es
// What virtual things take away from the light on a real surface (the contract's M).
// variant: VIRTUAL_CASTERS BLOCKER_TAPS=8 FILTER_TAPS=16
// variant: VIRTUAL_CASTERS REAL_CASTERS BLOCKER_TAPS=8 FILTER_TAPS=16
precision highp float;

#include "shadow/sun_map.glsl"
#include "scene/sh9.glsl"

uniform vec3 sun_direction_in_local;
uniform vec3 sun_illuminance;      // pre-exposed
uniform vec3 sky_irradiance_sh[9];  // pre-exposed, cosine-convolved

in vec3 v_position;
in vec3 v_normal;
layout(location = 0) out vec4 multiplier;

void main() {
  vec3 normal = normalize(v_normal);
  if (dot(normal, v_position) > 0.0) normal = -normal;  // the side that is seen
  float n_s = max(dot(normal, sun_direction_in_local), 0.0);
  float seen = virtual_visibility(v_position, normal);
  vec3 ratio = vec3(1.0);
  if (seen < 1.0 && n_s > 0.0) {
    vec3 sun = sun_illuminance * (n_s * real_visibility(v_position, normal));
    vec3 sky = max(sh9(sky_irradiance_sh, normal), vec3(0.0));
    ratio = (sun * seen + sky) / max(sun + sky, vec3(1e-20));
    if (dot(sun, vec3(1.0)) <= 0.0) ratio = vec3(1.0);
  }
  multiplier = vec4(ratio, 1.0);
}
