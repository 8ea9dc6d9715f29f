// Distance along the camera's axis, metres, of what a shaft pixel shows; kSkyM and more where there is nothing.
// A pixel that stands for several of the ideal picture takes the nearest and the farthest of them by turns, like the
// squares of a chessboard, so that both sides of every edge have a pixel to be upsampled from.
uniform highp sampler2D view_depth;

float distance_from_depth(float depth) {
  return depth < 1.0 ? near_m / max(1.0 - depth, 1e-12) : kSkyM;
}

float view_distance(vec2 pixel) {
#ifdef NO_DEPTH
  return kSkyM;
#else
  ivec2 size = textureSize(view_depth, 0);
  vec2 centre = pixel * view_px_per_px;
  if (view_px_per_px.x < 1.5) return distance_from_depth(texelFetch(view_depth, min(ivec2(centre), size - 1), 0).r);
  ivec2 at = clamp(ivec2(round(centre)) - 1, ivec2(0), size - 2);
  float a = texelFetch(view_depth, at, 0).r;
  float b = texelFetch(view_depth, at + ivec2(1, 0), 0).r;
  float c = texelFetch(view_depth, at + ivec2(0, 1), 0).r;
  float d = texelFetch(view_depth, at + ivec2(1, 1), 0).r;
  ivec2 square = ivec2(pixel);
  bool farthest = ((square.x + square.y) & 1) == 0;
  return distance_from_depth(farthest ? max(max(a, b), max(c, d)) : min(min(a, b), min(c, d)));
#endif
}
