// The view ray of a shaft pixel, the medium's segment of it, and the sun's light in it. Shared by all techniques.
// BOUNDED: the medium is a box. FALLOFF: it thins out with height. CASCADE: only the medium in a range of distances is
// looked at, and what several of them find is added up.
#ifndef OUT
#define OUT(type) out type
#endif
#include "lib/medium.glsl"
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

// The medium along a ray that enters the medium `entry` metres from the eye.
struct MediumPath {
  float entry;
#ifdef BOUNDED
  vec3 line_a;  // sun_path_lines()
  vec3 line_b;
#endif
#ifdef FALLOFF
  float rise;  // scale heights for a metre along the ray
#endif
};

MediumPath medium_along(Ray ray, float entry) {
  MediumPath path;
  path.entry = entry;
#ifdef BOUNDED
  sun_path_lines(vec3(0.0), ray.direction, box_low_in_local, box_high_in_local, sun_direction, path.line_a,
                 path.line_b);
#endif
#ifdef FALLOFF
  path.rise = ray.direction.z / scale_height_m;
#endif
  return path;
}

// Optical depth from where the ray enters the medium to t metres from the eye.
float view_depth_to(MediumPath path, float t) {
#ifdef FALLOFF
  return falloff_depth(log_extinction, path.rise * path.entry, path.rise * t, t - path.entry);
#else
  return extinction * (t - path.entry);
#endif
}

// Optical depth of the light's own way through the medium to that point. A medium without bounds takes the sun's light
// as given everywhere.
float sun_depth_to(MediumPath path, float t) {
#ifdef BOUNDED
  float way = sun_path(path.line_a, path.line_b, t);
#ifdef FALLOFF
  float height = path.rise * t;
  return falloff_depth(log_extinction, height, height + way * sun_direction.z / scale_height_m, way);
#else
  return extinction * way;
#endif
#else
  return 0.0;
#endif
}

// How far from the eye that optical depth is reached, counted from the entry.
float distance_at_optical_depth(MediumPath path, float depth) {
#ifdef FALLOFF
  float at_entry = exp(clamp(log_extinction - path.rise * path.entry, -80.0, 40.0));
  return path.entry + falloff_length(at_entry, path.rise, depth);
#else
  return path.entry + depth / max(extinction, 1e-20);
#endif
}

// What sunlight_between() needs of a point t metres from the eye. y: the optical depth of the view's way there and of
// the light's own. x: BOUNDED, the view's alone; else the light that all of the way there sends to the eye.
vec2 depth_sample_at(MediumPath path, float t) {
  float view = view_depth_to(path, t);
#ifdef BOUNDED
  return vec2(view, view + sun_depth_to(path, t));
#else
  return vec2(scattered_fraction(view), view);
#endif
}

// Part of the sun's light, at phase function and albedo 1, that the way between two points sends to the eye when
// nothing shadows it: integral of exp(-depth) d(view's depth). Exact in an unbounded medium, and in a homogeneous one
// between the kinks of the light's way.
float sunlight_between(vec2 depth_sample_a, vec2 depth_sample_b) {
  float more = max(depth_sample_b.x - depth_sample_a.x, 0.0);
#ifdef BOUNDED
  return more * exp(-min(depth_sample_a.y, depth_sample_b.y)) * fall_off(abs(depth_sample_b.y - depth_sample_a.y));
#else
  return more;
#endif
}

// The same for any segment.
float sunlight_of(MediumPath path, vec2 segment) {
#if defined(BOUNDED) && defined(FALLOFF)
  const int kPieces = 24;
  float sum = 0.0;
  vec2 depth_sample = depth_sample_at(path, segment.x);
  for (int i = 1; i <= kPieces; ++i) {
    vec2 next = depth_sample_at(path, mix(segment.x, segment.y, float(i) / float(kPieces)));
    sum += sunlight_between(depth_sample, next);
    depth_sample = next;
  }
  return segment.y > segment.x ? sum : 0.0;
#elif defined(BOUNDED)
  return bounded_fraction(extinction, segment, path.entry, path.line_a, path.line_b);
#else
  float before = view_depth_to(path, segment.x);
  float within = max(view_depth_to(path, segment.y) - before, 0.0);
  return exp(-before) * scattered_fraction(within);
#endif
}

// And for all of the way from the medium's edge to t metres from the eye.
float sunlight_to(MediumPath path, float t) {
#ifdef BOUNDED
  return sunlight_of(path, vec2(path.entry, t));
#else
  return scattered_fraction(max(view_depth_to(path, t), 0.0));
#endif
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
