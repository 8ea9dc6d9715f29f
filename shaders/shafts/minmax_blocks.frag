#version 310 es
// Nearest and farthest occluder of each 16 cells of a slice: the lowest level of its min-max tree (Chen 2011), and the
// same once more for minmax_levels.frag, which draws into the tree.
precision highp float;
precision highp int;

uniform highp usampler2D leaves;
uniform vec2 leaves_texel;  // 1 / size

layout(location = 0) out highp uvec2 bounds;
layout(location = 1) out highp uvec2 node;

void main() {
  vec2 at = vec2(floor(gl_FragCoord.x) * 4.0 + 0.5, gl_FragCoord.y) * leaves_texel;
  vec2 next = vec2(leaves_texel.x, 0.0);
  uvec4 a = textureLod(leaves, at, 0.0);
  uvec4 b = textureLod(leaves, at + next, 0.0);
  uvec4 c = textureLod(leaves, at + 2.0 * next, 0.0);
  uvec4 d = textureLod(leaves, at + 3.0 * next, 0.0);
  const uint kFirst = 0xffffu;  // minmax_leaves.frag: two rows
  uvec4 low = min(min(min(a & kFirst, b & kFirst), min(c & kFirst, d & kFirst)), min(min(a, b), min(c, d)) >> 16);
  uvec4 high = max(max(max(a & kFirst, b & kFirst), max(c & kFirst, d & kFirst)), max(max(a, b), max(c, d)) >> 16);
  bounds = uvec2(min(min(low.x, low.y), min(low.z, low.w)), max(max(high.x, high.y), max(high.z, high.w)));
  node = bounds;
}
