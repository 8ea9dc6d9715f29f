// What a pixel's surface is known by: where it is and which way it faces, in one float. Its high bits are the window
// depth's distance from the far end, near / z, to a relative 2^-15; its low eight bits the facing. 0: no surface.

// The facing's place in a square of 16 x 16 cells, each some 9 degrees wide. Octahedral: Cigolle et al. 2014, "A survey
// of efficient representations for independent unit vectors".
vec2 facing_cell(vec3 n) {
  vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  if (n.z < 0.0) p = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  return min(floor((p * 0.5 + 0.5) * 16.0), 15.0);
}

float surface_mark(float window_depth, vec3 normal) {
  uvec2 cell = uvec2(facing_cell(normal));
  return uintBitsToFloat((floatBitsToUint(max(1.0 - window_depth, 1e-20)) & ~255u) | (cell.y << 4u) | cell.x);
}
