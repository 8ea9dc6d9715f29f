#version 310 es
// The first occluders along each slice in the two rows that it runs between, four cells to a pixel, as steps of depth in
// 16 bits each, the row behind in the upper ones: 65535 where there is none.
precision highp float;
precision highp int;

#include "shafts/slice_rows.glsl"

uniform highp sampler2D slices;               // render/shafts/epipolar/slice_trees.h
uniform highp sampler2DArray occluder_depth;  // 0 to 1; 1 and more: none. Unfiltered
uniform int occluder_layer;                   // of it
uniform vec2 occluder_texel;                  // 1 / size
uniform vec2 eye_in_texels;
uniform float slices_texel;            // 1 / rows

layout(location = 0) out highp uvec4 leaves;

uvec4 steps_of(vec4 depth, bvec4 beyond) {
  bvec4 none = greaterThanEqual(mix(depth, vec4(1.0), beyond), vec4(1.0));
  return uvec4(ivec4(mix(max(depth, vec4(0.0)) * 65534.0, vec4(65535.0), none)));
}

void main() {
  vec4 slice = textureLod(slices, vec2(0.5, gl_FragCoord.y * slices_texel), 0.0);
  vec4 cell = floor(gl_FragCoord.x) * 4.0 + vec4(0.0, 1.0, 2.0, 3.0);
  bool by_x = abs(slice.x) >= abs(slice.y);
  vec4 along = (by_x ? eye_in_texels.x : eye_in_texels.y) + (by_x ? slice.x : slice.y) * (slice.z + cell + 0.5);
  vec4 row = floor(places_across(eye_in_texels, slice, cell)) + 0.5;
  float layer = float(occluder_layer);
  vec4 before;
  vec4 behind;
  for (int i = 0; i < 4; ++i) {
    vec2 at = by_x ? vec2(along[i], row[i]) : vec2(row[i], along[i]);
    vec2 next = by_x ? vec2(0.0, 1.0) : vec2(1.0, 0.0);
    before[i] = textureLod(occluder_depth, vec3(at * occluder_texel, layer), 0.0).r;
    behind[i] = textureLod(occluder_depth, vec3((at + next) * occluder_texel, layer), 0.0).r;
  }
  bvec4 beyond = greaterThanEqual(cell, vec4(slice.w));
  leaves = steps_of(before, beyond) | (steps_of(behind, beyond) << 16);
}
