#version 310 es
// How deep each tile of the view reaches: its largest depth.
precision highp float;

uniform highp sampler2D view_depth;  // unfiltered
uniform int tile_px;                 // even

layout(location = 0) out float farthest;

void main() {
  vec2 texel = 1.0 / vec2(textureSize(view_depth, 0));
  vec2 first = floor(gl_FragCoord.xy) * float(tile_px) + 1.0;  // where four pixels meet; those beyond the border repeat
  vec4 most = vec4(0.0);
  for (int y = 0; y < tile_px; y += 2) {
    for (int x = 0; x < tile_px; x += 2) {
      most = max(most, textureGather(view_depth, (first + vec2(x, y)) * texel, 0));
    }
  }
  farthest = max(max(most.x, most.y), max(most.z, most.w));
}
