#version 310 es
// Nearest and farthest caster of each 16 cells of a slice: the lowest level of its min-max tree (Chen 2011).
precision highp float;
precision highp int;

uniform highp usampler2D leaves;

layout(location = 0) out highp uvec2 bounds;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy) * ivec2(4, 1);
  uvec4 low = uvec4(65535u);
  uvec4 high = uvec4(0u);
  for (int i = 0; i < 4; ++i) {
    uvec4 four = texelFetch(leaves, at + ivec2(i, 0), 0);
    low = min(low, four);
    high = max(high, four);
  }
  bounds = uvec2(min(min(low.x, low.y), min(low.z, low.w)), max(max(high.x, high.y), max(high.z, high.w)));
}
