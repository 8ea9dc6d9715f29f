// How much of a part's sunlight gets past the occluders (x; `all` is what there is), and whether its end is lit (y), by
// the technique that LINE_MARCH chooses: steps along the ray, or else the min-max tree of the nearest epipolar slice.
// Needs shafts/ray.glsl.
#include "shafts/occluder_depth.glsl"
#ifdef LINE_MARCH
#include "shafts/steps.glsl"
#else
#include "shafts/minmax_traverse.glsl"
#endif

vec2 lit_sunlight(int row, Ray ray, MediumPath path, vec2 segment, vec2 part, float all) {
  vec2 shadowed = shadow_segment(ray.direction);
  vec2 marched = marched_segment(shadowed, path, segment, part);
  float reach = min(shadowed.y, part.y);
#ifdef LINE_MARCH
  vec2 lit = march(ray, path, marched, reach);
  return vec2(sunlight_when(lit.x, path, part, marched, reach, all), lit.y);
#else
  vec2 dark = traverse(row, ray, path, marched, reach);
  bool lit_somewhere = dark.x >= 0.0 || marched.x > part.x || reach < part.y;
  return vec2(lit_somewhere ? clamp(all - abs(dark.x), 0.0, all) : 0.0, dark.y);
#endif
}
