// A ray's way through the min-max tree of its epipolar slice: segments that lie before all occluders of a node, or
// behind them all, are taken whole, and cells are cut exactly where the ray meets the depth of their occluder. Needs
// ray.glsl.
precision highp int;

#include "shafts/slice_rows.glsl"

// Looked up by texture coordinates: software rasterisers take twice as long to fetch a texel by its number.
uniform highp sampler2D slices;   // render/shafts/epipolar/slice_trees.h
uniform highp usampler2D leaves;  // minmax_leaves.frag
uniform highp usampler2D levels;   // minmax_levels.frag
uniform vec2 leaves_texel;        // 1 / size
uniform vec2 levels_texel;
uniform ivec4 level_first;
uniform int top_level;
uniform mat4 texels_from_local;

// How much of a segment of cells one row of them shadows, metres. A ray that goes down the light is shadowed behind the
// occluder's depth, one that goes up is before it.
vec4 shadowed_m(vec4 occluder, vec4 begin, vec4 finish, float eye_depth, float slope) {
  vec4 meeting = (mix(occluder, vec4(1e30), greaterThan(occluder, vec4(65534.5))) - eye_depth) / slope;
  vec4 from = slope > 0.0 ? max(begin, meeting) : begin;
  vec4 to = slope > 0.0 ? finish : min(finish, meeting);
  return max(to - from, vec4(0.0));
}

// A ray over the cells of a slice.
struct SliceRay {
  vec4 slice;  // render/shafts/epipolar/slice_trees.h
  float row_at;
  float texels_per_m;
  float m_per_texel;
  float eye_depth;
  float slope;  // of depth, for each metre
  int cells;
  float to;  // metres from the eye
};

// How far a traversal has come.
struct Traversal {
  float t;            // metres from the eye
  vec2 depth_sample;  // there
  float dark;         // how much of the sunlight so far the occluders take
  bool any_lit;
  bool dark_end;
  int cell;
  int level;  // below 0: cells
};

SliceRay slice_ray(int row, Ray ray, vec2 segment) {
  SliceRay over;
  over.row_at = float(row) + 0.5;
  over.slice = textureLod(slices, vec2(0.5, over.row_at * leaves_texel.y), 0.0);
  vec3 along = mat3(texels_from_local) * ray.direction;
  over.texels_per_m = abs(over.slice.x) >= abs(over.slice.y) ? abs(along.x) : abs(along.y);
  over.m_per_texel = 1.0 / max(over.texels_per_m, 1e-12);
  over.eye_depth = texels_from_local[3].z;
  over.slope = abs(along.z) < 1e-12 ? 1e-12 : along.z;
  over.cells = int(over.slice.w);
  over.to = min(segment.y, (over.slice.z + over.slice.w) * over.m_per_texel);
  return over;
}

Traversal begin_traversal(SliceRay over, MediumPath path, vec2 segment) {
  Traversal at;
  at.t = segment.x;
  at.depth_sample = depth_sample_at(path, at.t);
  at.dark = 0.0;
  at.any_lit = false;
  at.dark_end = false;
  float first_t = over.slice.z * over.m_per_texel;
  if (at.t < first_t && over.cells > 0) {  // not yet over the map
    at.t = min(first_t, segment.y);
    at.depth_sample = depth_sample_at(path, at.t);
    at.any_lit = true;
  }
  at.cell = clamp(int(floor(at.t * over.texels_per_m - over.slice.z)), 0, max(over.cells - 1, 0));
  at.level = top_level;
  return at;
}

bool is_under_way(SliceRay over, Traversal at) {
  return at.t < over.to && at.cell < over.cells;
}

// Takes a node that is lit or shadowed as a whole, else goes down a level.
void take_node(SliceRay over, MediumPath path, inout Traversal at) {
  int shift = 4 + 2 * at.level;
  int node = at.cell >> shift;
  int first_node = at.level == 0 ? 0 : at.level == 1 ? level_first.y : at.level == 2 ? level_first.z : level_first.w;
  float end = min((over.slice.z + float((node + 1) << shift)) * over.m_per_texel, over.to);
  uvec2 found = textureLod(levels, levels_texel * vec2(float(first_node + node) + 0.5, over.row_at), 0.0).xy;
  vec2 bounds = vec2(ivec2(found));
  // Behind the last occluder that can be, and before the 65535 of no occluder.
  float from_depth = min(over.eye_depth + over.slope * at.t, 65534.5);
  float to_depth = min(over.eye_depth + over.slope * end, 65534.5);
  bool lit = max(from_depth, to_depth) <= bounds.x;
  bool shadowed = min(from_depth, to_depth) > bounds.y;
  if (lit || shadowed) {
    vec2 next = depth_sample_at(path, end);
    at.dark += shadowed ? sunlight_between(at.depth_sample, next) : 0.0;
    at.any_lit = at.any_lit || lit;
    at.dark_end = shadowed;
    at.depth_sample = next;
    at.t = max(at.t, end);
    at.cell = (node + 1) << shift;
    at.level = (node & 3) == 3 ? min(at.level + 1, top_level) : at.level;
  } else {
    at.level -= 1;
  }
}

// Four cells at a time, where a node of sixteen is neither lit nor shadowed as a whole.
void take_cells(SliceRay over, MediumPath path, inout Traversal at) {
  int four = at.cell >> 2;
  float four_end = min((over.slice.z + float(four * 4 + 4)) * over.m_per_texel, over.to);
  // Cells are long on rays that run along the light: no farther at once than the light hardly fades.
  float end = min(four_end,
                  max(distance_at_optical_depth(path, view_depth_to(path, at.t) + 0.05), at.t + 1e-6 * four_end));
  uvec4 occluders = textureLod(leaves, leaves_texel * vec2(float(four) + 0.5, over.row_at), 0.0);
  vec4 cells_of_four = float(four * 4) + vec4(0.0, 1.0, 2.0, 3.0);
  vec4 behind = fract(places_across(texels_from_local[3].xy, over.slice, cells_of_four));
  vec4 begin = (over.slice.z + cells_of_four) * over.m_per_texel;
  vec4 finish = clamp(begin + over.m_per_texel, at.t, end);
  begin = clamp(begin, at.t, end);
  vec4 before_m = shadowed_m(vec4(ivec4(occluders & 0xffffu)), begin, finish, over.eye_depth, over.slope);
  vec4 behind_m = shadowed_m(vec4(ivec4(occluders >> 16)), begin, finish, over.eye_depth, over.slope);
  float shadowed = dot(mix(before_m, behind_m, behind), vec4(1.0));
  vec2 next = depth_sample_at(path, end);
  at.dark += sunlight_between(at.depth_sample, next) * min(shadowed / max(end - at.t, 1e-20), 1.0);
  at.any_lit = at.any_lit || shadowed < (end - at.t) * (1.0 - 1e-5) - 1e-6 * end;  // not what rounding leaves
  at.dark_end = shadowed > 0.5 * (end - at.t);
  at.depth_sample = next;
  at.t = max(at.t, end);
  if (end >= four_end) {
    at.cell = four * 4 + 4;
    at.level = (four & 3) == 3 ? 0 : -1;
  }
}

// x: how much of the sunlight, from where the segment begins to its reach, the occluders take, as the slice of that row
// sees them; negative where that is all of it. y: 1 where it is lit at its end, else 0.
vec2 traverse(int row, Ray ray, MediumPath path, vec2 segment, float reach) {
  SliceRay over = slice_ray(row, ray, segment);
  Traversal at = begin_traversal(over, path, segment);
  while (is_under_way(over, at)) {
    while (at.level >= 0 && is_under_way(over, at)) take_node(over, path, at);
    while (at.level < 0 && is_under_way(over, at)) take_cells(over, path, at);
  }
  bool dark_end = at.dark_end && at.t >= segment.y;  // else the way leads off the map
  bool any_lit = at.any_lit || !dark_end;
  float dark = at.dark + (dark_end ? sunlight_between(at.depth_sample, depth_sample_at(path, reach)) : 0.0);
  float all = sunlight_of(path, vec2(segment.x, reach));
  any_lit = any_lit && all - dark > 2e-6 * all;  // nor what rounding leaves of the sums
  return vec2(any_lit ? min(dark, all) : -all, dark_end ? 0.0 : 1.0);
}
