// What a pixel's surface is known by: where it is and which way it faces, in one float. Its high bits are the window
// depth's distance from the far end, near / z, to a relative 2^-15; its low eight bits the facing. 0: no surface.

// Facing on a scale from 0 to 255: along an axis askew to all that people build, so that the sides of a thing differ.
float facing(vec3 normal) {
  return floor(127.5 + 127.0 * dot(normalize(normal), vec3(0.36, 0.48, 0.8)));
}

float surface_mark(float window_depth, vec3 normal) {
  return uintBitsToFloat((floatBitsToUint(max(1.0 - window_depth, 1e-20)) & ~255u) | uint(facing(normal)));
}
