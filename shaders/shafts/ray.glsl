// The view ray of a shaft pixel, the medium's segment of it, and the sun's light in it. Shared by all techniques.
// BOUNDED: the medium is a box. FALLOFF: it thins out with height. CASCADE: only the medium in a range of distances is
// looked at, and what several of them find is added up.
#ifndef OUT
#define OUT(type) out type
#endif
#include "lib/medium_path.glsl"
#include "shafts/medium_block.glsl"

uniform vec2 view_px_per_px;  // pixels of the ideal picture in one of this
#ifdef CASCADE
uniform vec2 cascade_m;  // the range, along the camera's axis
#endif

const float kSkyM = 1e9;     // what stands for no surface at all
const float kDeepest = 12.0;  // nothing beyond this optical depth is seen: exp(-12) = 6e-6

struct Ray {
  vec3 direction;  // unit, from the eye (the origin)
  float metres_per_z;  // along the ray for one metre along the camera's axis
};

Ray view_ray(vec2 pixel) {
  vec3 ray = local_ray_from_px * vec3(pixel * view_px_per_px, 1.0);
  float size = length(ray);
  return Ray(ray / size, size);
}

// The segment of the ray, up to the surface at z metres along the camera's axis, that lies in the medium.
vec2 medium_segment(Ray ray, float z) {
  vec2 segment = vec2(0.0, z < kSkyM ? z * ray.metres_per_z : 1e18);
#ifdef FALLOFF
  segment.y = min(segment.y, 1e10);
#endif
#ifdef BOUNDED
  segment = intersect(segment, box_segment(vec3(0.0), ray.direction, box_low_in_local, box_high_in_local));
#endif
  return segment;
}

MediumPath medium_along(Ray ray, float entry) {
  MediumShape shape = MediumShape(extinction, log_extinction, scale_height_m, box_low_in_local, box_high_in_local,
                                  sun_direction);
  return medium_path(shape, ray.direction, entry);
}

// The part of the medium's segment that this is about.
vec2 cascade_of(Ray ray, vec2 segment) {
#ifdef CASCADE
  vec2 part = intersect(segment, cascade_m * ray.metres_per_z);
  return part.y - part.x > 1e-5 * part.y ? part : vec2(part.x);  // less is rounding, too little to look at its end
#else
  return segment;
#endif
}

// And its sunlight.
float sunlight_in_cascade(MediumPath path, vec2 part) {
#ifdef CASCADE
  return sunlight_of(path, part);
#else
  return sunlight_to(path, part.y);
#endif
}

// Whether a segment of the ray ends there.
bool ends_in_cascade(Ray ray, vec2 segment) {
#ifdef CASCADE
  float end = max(segment.y, 0.0);
  return end >= cascade_m.x * ray.metres_per_z && end < cascade_m.y * ray.metres_per_z;
#else
  return true;
#endif
}

// Whether what several parts have in common is this one's to tell.
bool is_first_cascade() {
#ifdef CASCADE
  return cascade_m.x <= 0.0;
#else
  return true;
#endif
}
