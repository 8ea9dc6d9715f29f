#version 310 es
// Tints a technique's picture where the light comes through glass: takes away what the panes hold up of the light that
// gets past all other occluders, marched in steps through the prism that the glass's light fills and nowhere else.
precision highp float;

#include "shafts/ray.glsl"
#include "shafts/shading.glsl"
#include "shafts/view_depth.glsl"
#ifdef OCCLUDERS
#include "shafts/occluder_depth.glsl"
#endif
#include "shadow/translucent.glsl"

uniform highp sampler2D untinted;  // the technique's picture
uniform int steps;

layout(location = 0) out vec4 scattered;

float seen_past_occluders(Ray ray, float t) {
#ifdef OCCLUDERS
  vec3 at = map_from_local[3].xyz + mat3(map_from_local) * ray.direction * t;
  if (any(lessThan(at.xy, vec2(0.0))) || any(greaterThanEqual(at.xy, vec2(1.0)))) return 1.0;
  return textureLod(occluder_depth, vec3(at.xy, float(occluder_layer)), 0.0).r < min(at.z, 1.0) ? 0.0 : 1.0;
#else
  return 1.0;
#endif
}

vec2 behind_translucent(vec3 origin, vec3 d) {
  return intersect(intersect(slab(origin.x, d.x, 0.0, 1.0), slab(origin.y, d.y, 0.0, 1.0)),
                   slab(origin.z, d.z, 0.0, 1e20));
}

// Of the sun's light in the segment, what the panes take.
vec3 held_up(Ray ray, MediumPath path, vec2 segment) {
  vec3 origin = translucent_map_from_local[3].xyz;
  vec3 along = mat3(translucent_map_from_local) * ray.direction;
  vec2 seen = vec2(segment.x, min(segment.y, distance_at_optical_depth(path, kDeepest)));
  vec2 marched = intersect(behind_translucent(origin, along), seen);
  int count = marched.y > marched.x ? steps : 0;
  vec2 depth_sample = depth_sample_at(path, marched.x);
  vec3 held = vec3(0.0);
  for (int i = 1; i <= count; ++i) {
    float half_step = 0.5 * (marched.y - marched.x) / float(steps);
    float to = marched.x + 2.0 * half_step * float(i);
    vec2 next = depth_sample_at(path, to);
    vec3 tint = light_behind_translucent(origin + along * (to - half_step));
    held += sunlight_between(depth_sample, next) * seen_past_occluders(ray, to - half_step) * (1.0 - tint);
    depth_sample = next;
  }
  return held;
}

void main() {
  float z = view_distance(gl_FragCoord.xy);
  Ray ray = view_ray(gl_FragCoord.xy);
  vec2 segment = medium_segment(ray, z);
  MediumPath path = medium_along(ray, segment.x);
  vec3 held = held_up(ray, path, segment);
  float p = phase(phase_kind, phase_g, clamp(dot(ray.direction, sun_direction), -1.0, 1.0));
  scattered = texelFetch(untinted, ivec2(gl_FragCoord.xy), 0);
  // The two may differ by a step at the shadows' edges.
  scattered.rgb = max(scattered.rgb - sun_scattered * (p * held), vec3(0.0));
}
