#version 310 es
// The nearest and the farthest depth (r, g) in each block of a shadow map, and then around it: what tells the fully lit
// and the fully dark parts of a picture from the penumbras.
// variant: BLOCK=4
// variant:
precision highp float;

uniform highp sampler2DArray source;  // BLOCK: the maps, else bounds
uniform int layer;                    // of it
uniform ivec2 direction;         // without BLOCK: along which axis to reach out
uniform int reach;               // and how many texels of `source` to either side

layout(location = 0) out vec2 bounds;

void main() {
  ivec2 last = textureSize(source, 0).xy - 1;
  ivec2 at = ivec2(gl_FragCoord.xy);
  bounds = vec2(1.0, 0.0);
#ifdef BLOCK
  for (int i = 0; i < BLOCK * BLOCK; ++i) {
    float depth = texelFetch(source, ivec3(min(at * BLOCK + ivec2(i % BLOCK, i / BLOCK), last), layer), 0).r;
    bounds = vec2(min(bounds.x, depth), max(bounds.y, depth));
  }
#else
  for (int i = -reach; i <= reach; ++i) {
    vec2 there = texelFetch(source, ivec3(clamp(at + i * direction, ivec2(0), last), layer), 0).rg;
    bounds = vec2(min(bounds.x, there.x), max(bounds.y, there.y));
  }
#endif
}
