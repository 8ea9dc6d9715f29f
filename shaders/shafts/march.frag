#version 310 es
// Which part of the sunlight that the medium sends to the eye along each view ray gets past the casters. Only where
// the ray crosses the space that casters can shade is it marched; the weights are analytic, so that an unshaded ray
// comes out as exactly 1.
// variant: VIRTUAL_CASTERS
// variant: VIRTUAL_CASTERS BOUNDED
// variant: VIRTUAL_CASTERS REAL_CASTERS BOUNDED
// variant: REAL_CASTERS
precision highp float;

#include "shafts/ray.glsl"
#include "shafts/view_depth.glsl"

uniform int steps;
#ifdef VIRTUAL_CASTERS
uniform highp sampler2D virtual_depth;
uniform mat4 virtual_map_from_local;
#endif
#ifdef REAL_CASTERS
uniform highp sampler2D real_depth;
uniform mat4 real_map_from_local;
#endif

layout(location = 0) out vec2 lit_and_distance;

// Nothing beyond this optical depth is seen: exp(-12) = 6e-6.
const float kDeepest = 12.0;

// Where a ray is in the prism behind a map's near plane: there, casters may shade it.
vec2 shadow_stretch(mat4 map_from_local, vec3 direction) {
  vec3 origin = map_from_local[3].xyz;
  vec3 d = mat3(map_from_local) * direction;
  return intersect(intersect(slab(origin.x, d.x, 0.0, 1.0), slab(origin.y, d.y, 0.0, 1.0)),
                   slab(origin.z, d.z, 0.0, 1e20));
}

vec2 hull(vec2 a, vec2 b) {
  if (a.y <= a.x) return b;
  if (b.y <= b.x) return a;
  return vec2(min(a.x, b.x), max(a.y, b.y));
}

// `at` in texels across the map. The stretch lies inside the map, but rounding may step over its edge.
float lit_at(highp sampler2D map, vec3 at, int last) {
  return texelFetch(map, clamp(ivec2(at.xy), 0, last), 0).r < min(at.z, 1.0) ? 0.0 : 1.0;
}

float march(Ray ray, vec2 stretch, float entry, float offset) {
  float dt = (stretch.y - stretch.x) / float(steps);
#ifdef VIRTUAL_CASTERS
  vec3 virtual_at = (virtual_map_from_local * vec4(ray.direction * (stretch.x + dt * offset), 1.0)).xyz;
  vec3 virtual_step = mat3(virtual_map_from_local) * ray.direction * dt;
  int virtual_size = textureSize(virtual_depth, 0).x;
  virtual_at.xy *= float(virtual_size);
  virtual_step.xy *= float(virtual_size);
#endif
#ifdef REAL_CASTERS
  vec3 real_at = (real_map_from_local * vec4(ray.direction * (stretch.x + dt * offset), 1.0)).xyz;
  vec3 real_step = mat3(real_map_from_local) * ray.direction * dt;
  int real_size = textureSize(real_depth, 0).x;
  real_at.xy *= float(real_size);
  real_step.xy *= float(real_size);
#endif
#ifdef BOUNDED
  vec3 line_a;
  vec3 line_b;
  sun_path_lines(vec3(0.0), ray.direction, box_low_in_local, box_high_in_local, sun_direction_in_local, line_a, line_b);
#endif
  float fade = exp(-extinction * dt);  // each step's part of the light is the last one's times this
  float weight = 1.0;
  float lit = 0.0;
  float all = 0.0;
  for (int i = 0; i < steps; ++i) {
    float w = weight;
#ifdef BOUNDED
    w *= exp(-extinction * sun_path(line_a, line_b, stretch.x + dt * (float(i) + offset)));
#endif
    float seen = 1.0;
#ifdef VIRTUAL_CASTERS
    seen *= lit_at(virtual_depth, virtual_at, virtual_size - 1);
    virtual_at += virtual_step;
#endif
#ifdef REAL_CASTERS
    seen *= lit_at(real_depth, real_at, real_size - 1);
    real_at += real_step;
#endif
    lit += w * seen;
    all += w;
    weight *= fade;
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

  vec2 shaded = vec2(1.0, 0.0);
#ifdef VIRTUAL_CASTERS
  shaded = hull(shaded, shadow_stretch(virtual_map_from_local, ray.direction));
#endif
#ifdef REAL_CASTERS
  shaded = hull(shaded, shadow_stretch(real_map_from_local, ray.direction));
#endif
  shaded = intersect(shaded, vec2(stretch.x, min(stretch.y, stretch.x + kDeepest / max(extinction, 1e-9))));
  if (shaded.y <= shaded.x) return;

  float all = sunlit_fraction(ray, stretch, stretch.x);
  float part = sunlit_fraction(ray, shaded, stretch.x);
  if (part <= 0.0) return;
  float shadowed = part * (1.0 - march(ray, shaded, stretch.x, step_offset(ivec2(gl_FragCoord.xy))));
  lit_and_distance.x = clamp(1.0 - shadowed / max(all, 1e-30), 0.0, 1.0);
}
