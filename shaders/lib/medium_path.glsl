// A medium along a ray from the eye: optical depths, and the sunlight that goes down the ray when nothing shadows it.
// BOUNDED: the medium is a box. FALLOFF: it thins out with height. Pure functions, also compiled as C++. Lengths in
// metres. In-scattering as docs/shafts.md defines it, at phase function and albedo 1.
#include "lib/medium.glsl"

struct MediumShape {
  float extinction;      // sigma_t, 1/m; FALLOFF: not read
  float log_extinction;  // FALLOFF: logarithm of sigma_t at the eye
  float scale_height_m;  // FALLOFF
  vec3 box_low;          // BOUNDED: in the local frame, the eye at the origin
  vec3 box_high;
  vec3 sun_direction;    // BOUNDED: unit, towards the sun
};

// The medium along a ray from the eye that enters it `entry` metres from there.
struct MediumPath {
  MediumShape shape;
  float entry;
#ifdef BOUNDED
  vec3 line_a;  // sun_path_lines()
  vec3 line_b;
#endif
#ifdef FALLOFF
  float rise;  // scale heights for a metre along the ray
#endif
};

// `direction`: of the ray, unit.
MediumPath medium_path(MediumShape shape, vec3 direction, float entry) {
  MediumPath path;
  path.shape = shape;
  path.entry = entry;
#ifdef BOUNDED
  sun_path_lines(vec3(0.0f), direction, shape.box_low, shape.box_high, shape.sun_direction, path.line_a, path.line_b);
#endif
#ifdef FALLOFF
  path.rise = direction.z / shape.scale_height_m;
#endif
  return path;
}

// Optical depth from where the ray enters the medium to t metres from the eye.
float view_depth_to(MediumPath path, float t) {
#ifdef FALLOFF
  return falloff_depth(path.shape.log_extinction, path.rise * path.entry, path.rise * t, t - path.entry);
#else
  return path.shape.extinction * (t - path.entry);
#endif
}

// Optical depth of the light's own way through the medium to that point. A medium without bounds takes the sun's light
// as given everywhere.
float sun_depth_to(MediumPath path, float t) {
#ifdef BOUNDED
  float way = sun_path(path.line_a, path.line_b, t);
#ifdef FALLOFF
  float height = path.rise * t;
  float rise = way * path.shape.sun_direction.z / path.shape.scale_height_m;
  return falloff_depth(path.shape.log_extinction, height, height + rise, way);
#else
  return path.shape.extinction * way;
#endif
#else
  return 0.0f;
#endif
}

// How far from the eye that optical depth is reached, counted from the entry.
float distance_at_optical_depth(MediumPath path, float depth) {
#ifdef FALLOFF
  float at_entry = exp(clamp(path.shape.log_extinction - path.rise * path.entry, -80.0f, 40.0f));
  return path.entry + falloff_length(at_entry, path.rise, depth);
#else
  return path.entry + depth / max(path.shape.extinction, 1e-20f);
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
  float more = max(depth_sample_b.x - depth_sample_a.x, 0.0f);
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
  float sum = 0.0f;
  vec2 depth_sample = depth_sample_at(path, segment.x);
  for (int i = 1; i <= kPieces; ++i) {
    vec2 next = depth_sample_at(path, mix(segment.x, segment.y, float(i) / float(kPieces)));
    sum += sunlight_between(depth_sample, next);
    depth_sample = next;
  }
  return segment.y > segment.x ? sum : 0.0f;
#elif defined(BOUNDED)
  return bounded_fraction(path.shape.extinction, segment, path.entry, path.line_a, path.line_b);
#else
  float before = view_depth_to(path, segment.x);
  float within = max(view_depth_to(path, segment.y) - before, 0.0f);
  return exp(-before) * scattered_fraction(within);
#endif
}

// And for all of the way from the medium's edge to t metres from the eye.
float sunlight_to(MediumPath path, float t) {
#ifdef BOUNDED
  return sunlight_of(path, vec2(path.entry, t));
#else
  return scattered_fraction(max(view_depth_to(path, t), 0.0f));
#endif
}
