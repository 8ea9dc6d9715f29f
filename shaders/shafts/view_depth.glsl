// Distance along the camera's axis, metres, of what a shaft pixel shows; kSkyM and more where there is nothing.
// DIVIDED: a pixel stands for several of the ideal picture.
uniform highp sampler2D view_depth;  // unfiltered, clamped at its edges

float distance_from_depth(float depth) {
  return depth < 1.0 ? near_m / max(1.0 - depth, 1e-12) : kSkyM;
}

// At any place of the ideal picture. Depth is linear across the picture on a flat surface: interpolated where the four
// pixels around see one, so that a ray ends on it and not behind. Elsewhere the nearest or the farthest of them.
float distance_at(vec2 place, bool farthest) {
#ifdef NO_DEPTH
  return kSkyM;
#else
  ivec2 size = textureSize(view_depth, 0);
  ivec2 low = clamp(ivec2(floor(place - 0.5)), ivec2(0), max(size - 2, 0));
  vec4 depth = textureGather(view_depth, vec2(low + 1) / vec2(size)).wzxy;  // of (0, 0), (1, 0), (0, 1), (1, 1)
  float least = min(min(depth.x, depth.y), min(depth.z, depth.w));
  float most = max(max(depth.x, depth.y), max(depth.z, depth.w));
  vec2 part = place - 0.5 - vec2(low);  // beyond them at the picture's border
  float middle = mix(mix(depth.x, depth.y, part.x), mix(depth.z, depth.w, part.x), part.y);
  bool flat_there = most < 1.0 && middle < 1.0 && (1.0 - least) < 1.2 * (1.0 - most);
  return distance_from_depth(flat_there ? middle : farthest ? most : least);
#endif
}

// A pixel that stands for several takes the nearest and the farthest of what they see by turns, like the squares of a
// chessboard, so that both sides of every edge have a pixel to be upsampled from.
float view_distance(vec2 pixel) {
#ifdef NO_DEPTH
  return kSkyM;
#elif defined(DIVIDED)
  ivec2 square = ivec2(pixel);
  return distance_at(pixel * view_px_per_px, ((square.x + square.y) & 1) == 0);
#else
  return distance_from_depth(textureLod(view_depth, pixel / vec2(textureSize(view_depth, 0)), 0.0).r);
#endif
}
