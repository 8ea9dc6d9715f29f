// The mean of four pixels along one axis: one pass along each averages a tile of the march's step offsets exactly (Toth
// & Umenhoffer 2009, interleaved sampling). Pixels at another distance do not take part. r is averaged; g is the
// distance and stays.
vec2 tile_average(highp sampler2D lit_and_distance, ivec2 here, ivec2 axis) {
  ivec2 last = textureSize(lit_and_distance, 0) - 1;
  vec2 own = texelFetch(lit_and_distance, here, 0).rg;
  float sum = own.r;
  float weights = 1.0;
  for (int i = -1; i <= 2; ++i) {
    if (i == 0) continue;
    vec2 other = texelFetch(lit_and_distance, clamp(here + axis * i, ivec2(0), last), 0).rg;
    float weight = abs(other.g - own.g) <= 0.1 * own.g ? 1.0 : 0.0;
    sum += weight * other.r;
    weights += weight;
  }
  return vec2(sum / weights, own.g);
}
