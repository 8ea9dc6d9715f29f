// A march in steps. SPACING: 0 equal lengths, 1 equal optical depths, 2 growing lengths. Needs shafts/ray.glsl and
// shafts/occluder_depth.glsl. SUN_DISC: the sun is a disc, and what stands before part of it takes that part of its light
// (percentage-closer, wider with the way from the occluder); else a point.
#ifdef SUN_DISC
#include "shadow/shadow_maps.glsl"
#endif
#include "lib/steps.glsl"
#ifndef SPACING
#define SPACING 0
#endif
uniform int steps;
uniform int near_steps;    // growing: so many equal steps
uniform float near_way_m;  // up to this far into the segment, before they grow

// Where step i of the segment begins, metres from the eye.
float step_start(int i, MediumPath path, vec2 segment) {
  if (i >= steps) return segment.y;
#if SPACING == 1
  return step_of_equal_depth(i, steps, path, segment);
#elif SPACING == 2
  return growing_step(i, steps, near_steps, near_way_m, segment);
#else
  return equal_step(i, steps, segment);
#endif
}

// x: part of the sunlight, from where the segment begins to its reach, that gets past the occluders; 1 for an empty one.
// y: and at its end.
vec2 march(Ray ray, MediumPath path, vec2 segment, float reach) {
  vec3 origin = map_from_local[3].xyz;
  vec3 along = mat3(map_from_local) * ray.direction;
  float from = segment.x;
  vec2 depth_sample = depth_sample_at(path, from);
  float lit = 0.0;
  float all = 0.0;
  float seen = 1.0;
  int count = segment.y > segment.x ? steps : 0;
  for (int i = 1; i <= count; ++i) {
    float to = step_start(i, path, segment);
    vec2 next = depth_sample_at(path, to);
    float part = sunlight_between(depth_sample, next);
    all += part;
#ifdef SUN_DISC
    vec3 at = ray.direction * (0.5 * (from + to));
    seen = visibility_in_medium(kVirtual, at) * visibility_in_medium(kReal, at);
#else
    seen = filtered_lit_at(origin + along * (0.5 * (from + to)));
#endif
    lit += part * seen;
    from = to;
    depth_sample = next;
    if (depth_sample.y > kDeepest) break;  // nothing beyond is seen
  }
  float rest = count > 0 ? sunlight_between(depth_sample, depth_sample_at(path, reach)) : 0.0;
  all += rest;
  lit += rest * seen;
  return vec2(all > 0.0 ? lit / all : 1.0, seen);
}
