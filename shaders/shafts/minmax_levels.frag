#version 310 es
// The upper levels of the slices' min-max trees side by side: levels of 64, 256 and 1024 cells.
precision highp float;
precision highp int;

uniform highp usampler2D blocks;  // of 16 cells
uniform ivec4 level_first;        // column of each level's first node
uniform highp sampler2D slices;   // render/shafts/epipolar/slice_trees.h

layout(location = 0) out highp uvec2 bounds;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  int level = at.x >= level_first.w ? 3 : at.x >= level_first.z ? 2 : 1;
  int count = 1 << (2 * level);
  int from = (at.x - level_first[level]) * count;
  int to = min(from + count, int(ceil(texelFetch(slices, ivec2(0, at.y), 0).w / 16.0)));  // nothing was drawn beyond
  bounds = uvec2(65535u, 0u);
  for (int i = from; i < to; ++i) {
    uvec2 block = texelFetch(blocks, ivec2(i, at.y), 0).xy;
    bounds = uvec2(min(bounds.x, block.x), max(bounds.y, block.y));
  }
}
