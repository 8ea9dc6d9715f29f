// How much of the sun a surface point sees past the occluders of one shadow map.
#include "lib/shadow.glsl"

// What the search for blockers starts with.
struct BlockerSearch {
  float receiver;  // depth, biased
  vec2 radius;     // of the disc that may hold blockers, in map units
  bool lit;        // the sun's whole disc is seen, without a search
  bool dark;       // nothing of it is
};

//   depth_bounds  nearest and farthest depth (r, g) in the square of map.reach to either side
//   at_in_map     the receiver
//   slope         receiver_slope()
//   disc_slope    tangent of the sun's angular radius; 0: sharp
BlockerSearch blocker_search(highp sampler2DArray depth_bounds, ShadowMap map, vec3 at_in_map, vec2 slope,
                             float disc_slope) {
  BlockerSearch search;
  float texel = map.texel;
  search.receiver = biased_receiver(map, at_in_map.z, slope);
  search.radius = penumbra_radius(map, search.receiver, disc_slope) + texel;
  // On the sun's side of every occluder, or beside them all.
  bool beside = any(lessThan(at_in_map.xy, -search.radius)) || any(greaterThan(at_in_map.xy, 1.0 + search.radius));
  // Behind or before all that the search can meet: most of a picture is fully lit or fully dark. An empty texel holds
  // 1.
  vec2 bounds = textureLod(depth_bounds, vec3(at_in_map.xy, map.layer), 0.0).rg;
  float spread = dot(abs(slope), search.radius);
  bool bounded = max(search.radius.x, search.radius.y) + texel <= map.reach;
  search.lit = search.receiver <= 0.0 || beside || (bounded && min(search.receiver + spread, 1.0) <= bounds.x);
  search.dark = !search.lit && bounded && min(search.receiver - spread, 1.0) > bounds.y;
  // No blocker is farther up the light than the nearest depth.
  if (bounded) {
    float gap = max(search.receiver - bounds.x, 0.0);
    search.radius = min(search.radius, penumbra_radius(map, gap, disc_slope) + texel);
  }
  return search;
}

// Percentage-closer soft shadows (Fernando 2005) for a parallel sun with a disc: the penumbra of a blocker that is
// `gap` metres up the light is gap * tan(angular radius) in radius, wherever the receiver is. `depth_compare` and
// `depth_value` are the same maps with and without comparison; the rest as for blocker_search().
float sun_visibility(highp sampler2DArrayShadow depth_compare, highp sampler2DArray depth_value, ShadowMap map,
                     BlockerSearch search, vec3 at_in_map, vec2 slope, float disc_slope) {
  float texel = map.texel;
  vec3 metres_per_unit = map.metres_per_unit;
  // Software rasterisers run all code that no lane needs, and every loop once; what is decided takes no further turn.
  int search_taps = search.lit || search.dark ? 0 : BLOCKER_TAPS;
  float blockers = 0.0;
  float blocker_depth = 0.0;
  vec2 direction = vec2(1.0, 0.0);
  for (int i = 0; i < search_taps; ++i) {
    vec2 offset = direction * sqrt((float(i) + 0.5) / float(BLOCKER_TAPS)) * search.radius;
    direction = next_direction(direction);
    float depth = textureLod(depth_value, vec3(at_in_map.xy + offset, map.layer), 0.0).r;
    if (depth < min(search.receiver + dot(slope, offset), 1.0)) {
      blockers += 1.0;
      blocker_depth += depth;
    }
  }
  // A search that meets nothing is the answer. One that meets no gap is not: there are smaller ones than its few taps.
  bool undecided = blockers > 0.5;
  float gap_m = max(search.receiver - blocker_depth / max(blockers, 1.0), 0.0) * metres_per_unit.z;
  vec2 radius = max(disc_slope * gap_m / metres_per_unit.xy, vec2(0.75 * texel));
  // A narrow penumbra spans few texels, each look-up four.
  float reach_texels = max(radius.x, radius.y) / texel;
  int filter_taps = undecided ? min(4 + int(2.0 * reach_texels), FILTER_TAPS) : 0;
  float share = 1.0 / float(max(filter_taps, 1));
  float lit = 0.0;
  for (int i = 0; i < filter_taps; ++i) {
    vec2 offset = direction * sqrt((float(i) + 0.5) * share) * radius;
    direction = next_direction(direction);
    float reference = min(search.receiver + dot(slope, offset), 1.0);  // behind all occluders too, an empty texel is lit
    lit += texture(depth_compare, vec4(at_in_map.xy + offset, map.layer, reference));
  }
  if (undecided) return lit * share;
  return search.lit || (!search.dark && blockers < 0.5) ? 1.0 : 0.0;
}
