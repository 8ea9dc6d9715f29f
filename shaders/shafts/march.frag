#version 310 es
// Which part of the sunlight that the medium sends to the eye along each view ray gets past the casters. Only where
// the ray crosses the space that casters can shade is it marched; the weights are analytic, so that an unshaded ray
// comes out as exactly 1.
// variant:
// variant: NO_DEPTH
// variant: BOUNDED
precision highp float;

#include "shafts/ray.glsl"
#include "shafts/view_depth.glsl"

uniform int steps;           // at most, on a ray
uniform float least_step_m;  // a short way takes fewer
uniform highp sampler2D caster_depth;  // render/shafts/caster_map.h
uniform mat4 map_from_local;

layout(location = 0) out vec2 lit_and_distance;

// Nothing beyond this optical depth is seen: exp(-12) = 6e-6.
const float kDeepest = 12.0;

// Where a ray is in the prism behind the map's near plane: there, casters may shade it.
vec2 shadow_stretch(vec3 direction) {
  vec3 origin = map_from_local[3].xyz;
  vec3 d = mat3(map_from_local) * direction;
  return intersect(intersect(slab(origin.x, d.x, 0.0, 1.0), slab(origin.y, d.y, 0.0, 1.0)),
                   slab(origin.z, d.z, 0.0, 1e20));
}

// `at` in texels across the map. The stretch lies inside the map, but rounding may step over its edge: a fetch beyond
// it is 0, which must not count as shade.
float lit_at(vec3 at, ivec2 last) {
  return texelFetch(caster_depth, clamp(ivec2(at.xy), ivec2(0), last), 0).r < at.z ? 0.0 : 1.0;
}

float march(Ray ray, vec2 stretch, float offset) {
  // Four steps at a time share the sun's way through the medium.
  int blocks = int(clamp(ceil((stretch.y - stretch.x) / (4.0 * least_step_m)), 1.0, float(steps / 4)));
  float dt = (stretch.y - stretch.x) / float(4 * blocks);
  ivec2 size = textureSize(caster_depth, 0);
  vec3 texels = vec3(size, 1.0);
  vec3 at = texels * (map_from_local * vec4(ray.direction * (stretch.x + dt * offset), 1.0)).xyz;
  vec3 along = texels * (mat3(map_from_local) * ray.direction) * dt;
#ifdef BOUNDED
  vec3 line_a;
  vec3 line_b;
  sun_path_lines(vec3(0.0), ray.direction, box_low_in_local, box_high_in_local, sun_direction_in_local, line_a, line_b);
  float middle = stretch.x + dt * (1.5 + offset);
#endif
  float fade = exp(-extinction * dt);  // each step's part of the light is the last one's times this
  vec4 weights = vec4(1.0, fade, fade * fade, fade * fade * fade);
  float block_fade = weights.w * fade;
  float block_weight = 1.0;
  float lit = 0.0;
  float all = 0.0;
  for (int i = 0; i < blocks; ++i) {
    float weight = block_weight;
#ifdef BOUNDED
    weight *= exp(-extinction * sun_path(line_a, line_b, middle));
    middle += 4.0 * dt;
#endif
    vec4 seen;
    seen.x = lit_at(at, size - 1);
    seen.y = lit_at(at + along, size - 1);
    seen.z = lit_at(at + 2.0 * along, size - 1);
    seen.w = lit_at(at + 3.0 * along, size - 1);
    lit += weight * dot(seen, weights);
    all += weight * dot(vec4(1.0), weights);
    at += 4.0 * along;
    block_weight *= block_fade;
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
  vec2 stretch = medium_stretch(ray, z);
  lit_and_distance = vec2(1.0, z);
  if (stretch.y <= stretch.x) return;

  float deepest = min(stretch.y, stretch.x + kDeepest / max(extinction, 1e-9));
  vec2 shaded = intersect(shadow_stretch(ray.direction), vec2(stretch.x, deepest));
  if (shaded.y <= shaded.x) return;

  float all = sunlit_fraction(ray, stretch, stretch.x);
  float part = sunlit_fraction(ray, shaded, stretch.x);
  if (part <= 0.0) return;
  float shadowed = part * (1.0 - march(ray, shaded, step_offset(ivec2(gl_FragCoord.xy))));
  lit_and_distance.x = clamp(1.0 - shadowed / max(all, 1e-30), 0.0, 1.0);
}
