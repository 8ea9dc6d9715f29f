// Which part of a pixel's sunlight gets past the casters (x), and whether its end is lit (y), by the technique that
// LINE_MARCH chooses: steps along the ray, or else the min-max tree of the nearest epipolar slice. Needs
// shafts/ray.glsl.
#include "shafts/caster_depth.glsl"
#ifdef LINE_MARCH
#include "shafts/steps.glsl"
#else
#include "shafts/walk.glsl"
#endif

vec2 lit_share(int row, Ray ray, Air air, vec2 stretch) {
  vec2 marched = marched_stretch(ray.direction, air, stretch);
#ifdef LINE_MARCH
  vec2 lit = march(ray, air, marched, marched_reach(ray.direction, stretch));
#else
  vec2 lit = walk(row, ray, air, marched, marched_reach(ray.direction, stretch));
#endif
  float all = sunlight_of(air, stretch);
  lit.x = all > 0.0 ? clamp(sunlight_when(lit.x, ray.direction, air, stretch, marched) / all, 0.0, 1.0) : 1.0;
  return lit;
}
