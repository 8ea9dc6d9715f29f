// How much of a part's sunlight gets past the casters (x; `all` is what there is), and whether its end is lit (y), by
// the technique that LINE_MARCH chooses: steps along the ray, or else the min-max tree of the nearest epipolar slice.
// Needs shafts/ray.glsl.
#include "shafts/caster_depth.glsl"
#ifdef LINE_MARCH
#include "shafts/steps.glsl"
#else
#include "shafts/walk.glsl"
#endif

vec2 lit_sunlight(int row, Ray ray, Air air, vec2 stretch, vec2 part, float all) {
  vec2 shaded = shadow_stretch(ray.direction);
  vec2 marched = marched_stretch(shaded, air, stretch, part);
  float reach = min(shaded.y, part.y);
#ifdef LINE_MARCH
  vec2 lit = march(ray, air, marched, reach);
  return vec2(sunlight_when(lit.x, air, part, marched, reach, all), lit.y);
#else
  vec2 dark = walk(row, ray, air, marched, reach);
  bool lit_somewhere = dark.x >= 0.0 || marched.x > part.x || reach < part.y;
  return vec2(lit_somewhere ? clamp(all - abs(dark.x), 0.0, all) : 0.0, dark.y);
#endif
}
