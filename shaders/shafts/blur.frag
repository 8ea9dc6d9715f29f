#version 310 es
// Averages four pixels along one axis: two such passes average a tile of the march's step offsets exactly (Toth &
// Umenhoffer 2009, interleaved sampling). Pixels at another distance do not take part.
precision highp float;

uniform highp sampler2D lit_and_distance;
uniform ivec2 axis;  // (1, 0) or (0, 1)

layout(location = 0) out vec2 blurred;

void main() {
  ivec2 last = textureSize(lit_and_distance, 0) - 1;
  ivec2 here = ivec2(gl_FragCoord.xy);
  vec2 own = texelFetch(lit_and_distance, here, 0).rg;
  float sum = 0.0;
  float weights = 0.0;
  for (int i = -1; i <= 2; ++i) {
    vec2 other = texelFetch(lit_and_distance, clamp(here + axis * i, ivec2(0), last), 0).rg;
    float weight = abs(other.y - own.y) <= 0.1 * own.y ? 1.0 : 0.0;
    sum += weight * other.x;
    weights += weight;
  }
  blurred = vec2(sum / weights, own.y);  // the pixel itself always takes part
}
