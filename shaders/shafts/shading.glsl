// Light that the medium sends to the eye, and what it lets through: closed forms, times the part of the sun's light
// that a technique found to get past the occluders. Every technique ends here. SKY_AT_CORNERS: the sky's light, which
// varies slowly, is interpolated between the corners of cells. Needs shafts/ray.glsl.

// Scattered from all of the sky to the eye by endless medium.
#ifdef SKY_AT_CORNERS
in vec3 sky_light;  // cells.vert
vec3 sky_seen(Ray ray) {
  return sky_light;
}
#else
#include "shafts/sky_scattered.glsl"
vec3 sky_seen(Ray ray) {
  return sky_scattered(ray.direction);
}
#endif

// To the nearest of what half floats can hold: drivers may cut off the rest as they store them (Mesa's llvmpipe does),
// which darkens all of a picture by a 3,000th.
vec4 nearest_half(vec4 value) {
  highp uvec4 bits = floatBitsToUint(value);
  return uintBitsToFloat((bits + 0x1000u) & 0xffffe000u);
}

// Half floats end at 65504, which the sum of up to four parts must not reach.
#ifdef CASCADE
const float kBrightest = 16000.0;
#else
const float kBrightest = 60000.0;
#endif

// rgb: luminance; a: transmittance. `sunlit` is sunlight_of() the segment, less what is shadowed.
vec4 medium_light(Ray ray, MediumPath path, vec2 segment, float sunlit) {
  if (segment.y <= segment.x) return vec4(0.0, 0.0, 0.0, is_first_cascade() ? 1.0 : 0.0);
  float depth = max(view_depth_to(path, segment.y), 0.0);
  float p = phase(phase_kind, phase_g, clamp(dot(ray.direction, sun_direction), -1.0, 1.0));
  vec3 light = sun_scattered * (p * sunlit);
#ifdef CASCADE
  if (!is_first_cascade()) return nearest_half(vec4(min(light, vec3(kBrightest)), 0.0));
#endif
  light += sky_seen(ray) * scattered_fraction(depth);
  return nearest_half(vec4(min(light, vec3(kBrightest)), exp(-depth)));
}
