#version 310 es
// Which part of the sunlight that the medium sends to the eye along each view ray gets past the occluders. Only where
// the ray crosses the space that occluders can shadow is it marched; the weights are analytic, so that an unshadowed ray
// comes out as exactly 1.
precision highp float;

#include "shafts/ray.glsl"
#include "shafts/view_depth.glsl"
#include "shafts/occluder_depth.glsl"

uniform int steps;           // at most, on a ray
uniform float least_step_m;  // a short way takes fewer

layout(location = 0) out vec2 lit_and_distance;

float march(Ray ray, MediumPath path, vec2 segment, float offset) {
  // Four steps at a time share the sun's way through the medium.
  int blocks = int(clamp(ceil((segment.y - segment.x) / (4.0 * least_step_m)), 1.0, float(steps / 4)));
  float dt = (segment.y - segment.x) / float(4 * blocks);
  ivec2 size = textureSize(occluder_depth, 0).xy;
  vec3 texels = vec3(size, 1.0);
  vec3 at = texels * (map_from_local * vec4(ray.direction * (segment.x + dt * offset), 1.0)).xyz;
  vec3 along = texels * (mat3(map_from_local) * ray.direction) * dt;
#ifdef FALLOFF
  const vec4 weights = vec4(1.0);
  float from = segment.x;
  vec2 depth_sample = depth_sample_at(path, from);
#else
  float fade = exp(-extinction * dt);  // each step's part of the light is the last one's times this
  vec4 weights = vec4(1.0, fade, fade * fade, fade * fade * fade);
  float block_fade = weights.w * fade;
  float block_weight = 1.0;
#ifdef BOUNDED
  float middle = segment.x + dt * (1.5 + offset);
#endif
#endif
  float lit = 0.0;
  float all = 0.0;
  for (int i = 0; i < blocks; ++i) {
#ifdef FALLOFF
    from += 4.0 * dt;
    vec2 next = depth_sample_at(path, from);
    float weight = sunlight_between(depth_sample, next);
    depth_sample = next;
#else
    float weight = block_weight;
    block_weight *= block_fade;
#ifdef BOUNDED
    weight *= exp(-sun_depth_to(path, middle));
    middle += 4.0 * dt;
#endif
#endif
    vec4 seen;
    seen.x = lit_at(at, size - 1);
    seen.y = lit_at(at + along, size - 1);
    seen.z = lit_at(at + 2.0 * along, size - 1);
    seen.w = lit_at(at + 3.0 * along, size - 1);
    lit += weight * dot(seen, weights);
    all += weight * dot(vec4(1.0), weights);
    at += 4.0 * along;
  }
  return all > 0.0 ? lit / all : 1.0;
}

// A different place in the step for each pixel of a 4 x 4 tile, in an order that spreads neighbours (Bayer 1973);
// the blur that follows averages a tile.
float step_offset(ivec2 pixel) {
  const int order[16] = int[16](0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5);
  return (float(order[(pixel.y & 3) * 4 + (pixel.x & 3)]) + 0.5) / 16.0;
}

void main() {
  float z = view_distance(gl_FragCoord.xy);
  Ray ray = view_ray(gl_FragCoord.xy);
  vec2 segment = medium_segment(ray, z);
  lit_and_distance = vec2(1.0, z);
  if (segment.y <= segment.x) return;

  MediumPath path = medium_along(ray, segment.x);
  vec2 shadow = shadow_segment(ray.direction);
  vec2 marched = marched_segment(shadow, path, segment, segment);
  if (marched.y <= marched.x) return;
  float lit = march(ray, path, marched, step_offset(ivec2(gl_FragCoord.xy)));
  float all = sunlight_to(path, segment.y);
  float sunlit = sunlight_when(lit, path, segment, marched, min(shadow.y, segment.y), all);
  lit_and_distance.x = clamp(sunlit / max(all, 1e-30), 0.0, 1.0);
}
