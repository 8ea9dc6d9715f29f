// A unit vector as a whole number from 1 to 1024, which a half float holds exactly; 0 stays free for "nothing".
// Octahedral: Cigolle et al. 2014, "A survey of efficient representations for independent unit vectors".
float facing_code(vec3 n) {
  vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  if (n.z < 0.0) p = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  vec2 cell = min(floor((p * 0.5 + 0.5) * 32.0), 31.0);
  return 1.0 + cell.x + 32.0 * cell.y;
}

// The direction in the middle of the code's cell, up to 0.07 rad from the vector itself.
vec3 facing_of(float code) {
  float y = floor((code - 1.0) / 32.0);
  vec2 p = (vec2(code - 1.0 - 32.0 * y, y) + 0.5) / 16.0 - 1.0;
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
  return normalize(n);
}
