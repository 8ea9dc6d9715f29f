#version 310 es
// The first casters along each slice, four cells to a pixel, as steps of depth; kNoCaster where there is none.
precision highp float;
precision highp int;

uniform highp sampler2D slices;
uniform highp sampler2D caster_depth;  // 0 to 1; 1 and more: none
uniform vec2 eye_in_texels;

layout(location = 0) out highp uvec4 leaves;

void main() {
  vec4 slice = texelFetch(slices, ivec2(0, int(gl_FragCoord.y)), 0);
  ivec2 last = textureSize(caster_depth, 0) - 1;
  float cell = floor(gl_FragCoord.x) * 4.0;
  vec4 found;
  for (int i = 0; i < 4; ++i) {
    vec2 at = eye_in_texels + slice.xy * (slice.z + cell + 0.5);
    float depth = texelFetch(caster_depth, clamp(ivec2(floor(at)), ivec2(0), last), 0).r;
    found[i] = depth >= 1.0 || cell >= slice.w ? 65535.0 : max(depth, 0.0) * 65534.0;
    cell += 1.0;
  }
  leaves = uvec4(found);
}
