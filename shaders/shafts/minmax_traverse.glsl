// A ray's way through the min-max tree of its epipolar slice: segments that lie before all occluders of a node, or
// behind them all, are taken whole, and cells are cut exactly where the ray meets the depth of their occluder. Needs
// ray.glsl.
precision highp int;

#include "shafts/slice_rows.glsl"

// Looked up by texture coordinates: software rasterisers take twice as long to fetch a texel by its number.
uniform highp sampler2D slices;   // render/shafts/epipolar/slice_trees.h
uniform highp usampler2D leaves;  // leaves.frag
uniform highp usampler2D levels;   // levels.frag
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

// x: how much of the sunlight, from where the segment begins to its reach, the occluders take, as the slice of that row
// sees them; negative where that is all of it. y: 1 where it is lit at its end, else 0.
vec2 traversal(int row, Ray ray, MediumPath path, vec2 segment, float reach) {
  float row_at = float(row) + 0.5;
  vec4 slice = textureLod(slices, vec2(0.5, row_at * leaves_texel.y), 0.0);
  vec3 along = mat3(texels_from_local) * ray.direction;
  float texels_per_m = abs(slice.x) >= abs(slice.y) ? abs(along.x) : abs(along.y);
  float m_per_texel = 1.0 / max(texels_per_m, 1e-12);
  float eye_depth = texels_from_local[3].z;
  float slope = abs(along.z) < 1e-12 ? 1e-12 : along.z;
  vec2 eye_in_texels = texels_from_local[3].xy;
  int cells = int(slice.w);

  float t = segment.x;
  float to = min(segment.y, (slice.z + slice.w) * m_per_texel);
  vec2 depth_sample = depth_sample_at(path, t);
  float dark = 0.0;
  bool any_lit = false;
  bool dark_end = false;
  float first_t = slice.z * m_per_texel;
  if (t < first_t && cells > 0) {  // not yet over the map
    t = min(first_t, segment.y);
    depth_sample = depth_sample_at(path, t);
    any_lit = true;
  }
  int cell = clamp(int(floor(t * texels_per_m - slice.z)), 0, max(cells - 1, 0));
  int level = top_level;
  while (t < to && cell < cells) {
    while (level >= 0 && t < to && cell < cells) {
      int shift = 4 + 2 * level;
      int node = cell >> shift;
      int first_node = level == 0 ? 0 : level == 1 ? level_first.y : level == 2 ? level_first.z : level_first.w;
      float end = min((slice.z + float((node + 1) << shift)) * m_per_texel, to);
      uvec2 found = textureLod(levels, levels_texel * vec2(float(first_node + node) + 0.5, row_at), 0.0).xy;
      vec2 bounds = vec2(ivec2(found));
      // Behind the last occluder that can be, and before the 65535 of no occluder.
      float from_depth = min(eye_depth + slope * t, 65534.5);
      float to_depth = min(eye_depth + slope * end, 65534.5);
      bool lit = max(from_depth, to_depth) <= bounds.x;
      bool shadowed = min(from_depth, to_depth) > bounds.y;
      if (lit || shadowed) {
        vec2 next = depth_sample_at(path, end);
        dark += shadowed ? sunlight_between(depth_sample, next) : 0.0;
        any_lit = any_lit || lit;
        dark_end = shadowed;
        depth_sample = next;
        t = max(t, end);
        cell = (node + 1) << shift;
        level = (node & 3) == 3 ? min(level + 1, top_level) : level;
      } else {
        level -= 1;
      }
    }
    // Four cells at a time, where a node of sixteen is neither lit nor shadowed as a whole.
    while (level < 0 && t < to && cell < cells) {
      int four = cell >> 2;
      float four_end = min((slice.z + float(four * 4 + 4)) * m_per_texel, to);
      // Cells are long on rays that run along the light: no farther at once than the light hardly fades.
      float end = min(four_end, max(distance_at_optical_depth(path, view_depth_to(path, t) + 0.05), t + 1e-6 * four_end));
      uvec4 occluders = textureLod(leaves, leaves_texel * vec2(float(four) + 0.5, row_at), 0.0);
      vec4 cells_of_four = float(four * 4) + vec4(0.0, 1.0, 2.0, 3.0);
      vec4 behind = fract(places_across(eye_in_texels, slice, cells_of_four));
      vec4 begin = (slice.z + cells_of_four) * m_per_texel;
      vec4 finish = clamp(begin + m_per_texel, t, end);
      begin = clamp(begin, t, end);
      vec4 before_m = shadowed_m(vec4(ivec4(occluders & 0xffffu)), begin, finish, eye_depth, slope);
      vec4 behind_m = shadowed_m(vec4(ivec4(occluders >> 16)), begin, finish, eye_depth, slope);
      float shadowed = dot(mix(before_m, behind_m, behind), vec4(1.0));
      vec2 next = depth_sample_at(path, end);
      dark += sunlight_between(depth_sample, next) * min(shadowed / max(end - t, 1e-20), 1.0);
      any_lit = any_lit || shadowed < (end - t) * (1.0 - 1e-5) - 1e-6 * end;  // not what rounding leaves
      dark_end = shadowed > 0.5 * (end - t);
      depth_sample = next;
      t = max(t, end);
      if (end >= four_end) {
        cell = four * 4 + 4;
        level = (four & 3) == 3 ? 0 : -1;
      }
    }
  }
  dark_end = dark_end && t >= segment.y;  // else the way leads off the map
  any_lit = any_lit || !dark_end;
  dark += dark_end ? sunlight_between(depth_sample, depth_sample_at(path, reach)) : 0.0;
  float all = sunlight_of(path, vec2(segment.x, reach));
  any_lit = any_lit && all - dark > 2e-6 * all;  // nor what rounding leaves of the sums
  return vec2(any_lit ? min(dark, all) : -all, dark_end ? 0.0 : 1.0);
}
