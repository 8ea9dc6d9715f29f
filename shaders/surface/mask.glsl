// Alpha for coverage, 0 to 1: sharpened to one pixel about the cutoff, and raised in smaller mipmaps, whose averaging
// would thin out leaves (Golus 2017, "Anti-aliased alpha test").
float mask_coverage(float alpha, float cutoff, vec2 uv, vec2 texture_size) {
  vec2 dx = dFdx(uv) * texture_size;
  vec2 dy = dFdy(uv) * texture_size;
  float level = max(0.0, 0.5 * log2(max(dot(dx, dx), dot(dy, dy))));
  alpha *= 1.0 + 0.25 * level;
  return clamp((alpha - cutoff) / max(fwidth(alpha), 1e-4) + 0.5, 0.0, 1.0);
}
