#version 310 es
// The first casters along each slice, four cells to a pixel, as steps of depth: 65535 where there is none.
precision highp float;
precision highp int;

uniform highp sampler2D slices;        // render/shafts/slice_trees.h
uniform highp sampler2D caster_depth;  // 0 to 1; 1 and more: none. Unfiltered
uniform vec2 caster_texel;             // 1 / size
uniform vec2 eye_in_texels;
uniform float slices_texel;            // 1 / rows

layout(location = 0) out highp uvec4 leaves;

void main() {
  vec4 slice = textureLod(slices, vec2(0.5, gl_FragCoord.y * slices_texel), 0.0);
  float cell = floor(gl_FragCoord.x) * 4.0;
  vec2 at = (eye_in_texels + slice.xy * (slice.z + cell + 0.5)) * caster_texel;
  vec2 along = slice.xy * caster_texel;
  vec4 depth = vec4(textureLod(caster_depth, at, 0.0).r, textureLod(caster_depth, at + along, 0.0).r,
                    textureLod(caster_depth, at + 2.0 * along, 0.0).r, textureLod(caster_depth, at + 3.0 * along, 0.0).r);
  bvec4 none = greaterThanEqual(max(depth, step(vec4(slice.w), cell + vec4(0.0, 1.0, 2.0, 3.0))), vec4(1.0));
  leaves = uvec4(ivec4(mix(max(depth, vec4(0.0)) * 65534.0, vec4(65535.0), none)));
}
