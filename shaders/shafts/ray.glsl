// The view ray of a shaft pixel, and the medium's stretch of it. Shared by the passes of all techniques.
#ifndef OUT
#define OUT(type) out type
#endif
#include "shafts/medium.glsl"

uniform mat3 local_ray_from_px;  // render/scene/view.h
uniform vec2 view_px_per_px;     // pixels of the ideal picture in one of this
uniform float near_m;            // View::kNearM
uniform float extinction;        // 1/m
#ifdef BOUNDED
uniform vec3 box_low_in_local;
uniform vec3 box_high_in_local;
uniform vec3 sun_direction_in_local;
#endif

const float kSkyM = 1e9;  // what stands for no surface at all

struct Ray {
  vec3 direction;  // unit, from the eye (the origin)
  float metres_per_z;  // along the ray for one metre along the camera's axis
};

Ray view_ray(vec2 pixel) {
  vec3 ray = local_ray_from_px * vec3(pixel * view_px_per_px, 1.0);
  float size = length(ray);
  return Ray(ray / size, size);
}

// The stretch of the ray, up to the surface at z metres along the camera's axis, that lies in the medium.
vec2 medium_stretch(Ray ray, float z) {
  vec2 stretch = vec2(0.0, z < kSkyM ? z * ray.metres_per_z : 1e18);
#ifdef BOUNDED
  stretch = intersect(stretch, box_stretch(vec3(0.0), ray.direction, box_low_in_local, box_high_in_local));
#endif
  return stretch;
}

// Part of the sun's light, at phase function and albedo 1, that a stretch of the medium sends to the eye when nothing
// shades it. `entry` is where the ray enters the medium.
float sunlit_fraction(Ray ray, vec2 stretch, float entry) {
#ifdef BOUNDED
  vec3 line_a;
  vec3 line_b;
  sun_path_lines(vec3(0.0), ray.direction, box_low_in_local, box_high_in_local, sun_direction_in_local, line_a, line_b);
  return bounded_fraction(extinction, stretch, entry, line_a, line_b);
#else
  return unbounded_fraction(extinction, stretch);
#endif
}
