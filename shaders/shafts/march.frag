#version 310 es
// Brute force: each pixel's ray is marched by itself. The weights are analytic, so that an unshaded ray is exact.
// variant:
// variant: NO_DEPTH
// variant: BOUNDED
// variant: FALLOFF SPACING=1
// variant: SPACING=2
// variant: PARTED
// variant: PARTED BOUNDED FALLOFF
// variant: BOUNDED FALLOFF
// variant: SUN_DISC VIRTUAL_CASTERS BLOCKER_TAPS=8 FILTER_TAPS=16
// variant: BOUNDED SUN_DISC VIRTUAL_CASTERS REAL_CASTERS BLOCKER_TAPS=8 FILTER_TAPS=16
precision highp float;

#include "shafts/ray.glsl"
#include "shafts/shade.glsl"
#include "shafts/view_depth.glsl"
#include "shafts/caster_depth.glsl"
#include "shafts/steps.glsl"

layout(location = 0) out vec4 scattered;
layout(location = 1) out float distance_along_axis;

void main() {
  float z = view_distance(gl_FragCoord.xy);
  Ray ray = view_ray(gl_FragCoord.xy);
  vec2 stretch = medium_stretch(ray, z);
  Air air = air_along(ray, stretch.x);
  distance_along_axis = is_first_part() ? z : 0.0;
  vec2 part = part_of(ray, stretch);
  vec2 shadow = shadow_stretch(ray.direction);
  vec2 marched = marched_stretch(shadow, air, stretch, part);
  float reach = min(shadow.y, part.y);
  float lit = march(ray, air, marched, reach).x;
  float all = sunlight_in(air, part);
  scattered = shaded_air(ray, air, stretch, sunlight_when(lit, air, part, marched, reach, all));
}
