// A medium, homogeneous or thinning out with height, along a view ray (docs/shafts.md). Pure functions, written in
// the part of GLSL that GLM compiles as C++ too, so that the tests need no GPU. Lengths in metres, extinction in 1/m.

// (1 - exp(-x)) / x for |x| < 0.05, good to 1e-9.
float fall_off_series(float x) {
  return 1.0f - x * (0.5f - x * (1.0f / 6.0f - x * (1.0f / 24.0f - x / 120.0f)));
}

// (1 - exp(-x)) / x, for any x that does not overflow; 1 at x = 0.
float fall_off(float x) {
  return abs(x) < 0.05f ? fall_off_series(x) : (1.0f - exp(-x)) / x;  // the quotient cancels near 0
}

// 1 - exp(-x) for x >= 0, accurate for x -> 0.
float scattered_fraction(float x) {
  return x < 0.05f ? x * fall_off_series(x) : 1.0f - exp(-x);
}

// Integral of extinction * exp(-(start + slope * t)) dt over [0, length]; start and start + slope * length are optical
// depths, >= 0; slope in 1/m may have either sign.
float attenuated_fraction(float extinction, float start, float slope, float length_m) {
  float x = slope * length_m;
  // Count from the end with the lower optical depth: both exponents stay <= 0.
  return extinction * length_m * exp(-min(start, start + x)) * fall_off(abs(x));
}

// Optical depth of a straight way through air whose extinction is exp(log_extinction - height), heights in scale
// heights: extinction of the lower end times the length times (1 - exp(-x)) / x with x the rise. Stays finite.
float falloff_depth(float log_extinction, float height_a, float height_b, float length_m) {
  float low = exp(clamp(log_extinction - min(height_a, height_b), -80.0f, 40.0f));
  return min(low * length_m * fall_off(abs(height_b - height_a)), 1e30f);
}

// Length of the way from a point of that extinction, along which the height grows by `rise` scale heights a metre,
// that has this optical depth; 1e20 where none has.
float falloff_length(float extinction, float rise, float depth) {
  float x = rise * depth / max(extinction, 1e-30f);
  if (abs(x) < 1e-3f) return depth / max(extinction, 1e-20f) * (1.0f + 0.5f * x);
  return x < 1.0f ? -log(1.0f - x) / rise : 1e20f;
}

// Phase functions, 1/sr; cos_theta as in render/medium/medium.h.
// 0: Henyey & Greenstein 1941. 1: Cornette & Shanks 1992, eq. 8. 2: Rayleigh.
float phase(int kind, float g, float cos_theta) {
  const float quarter_inverse_pi = 0.0795774715f;
  if (kind == 2) return quarter_inverse_pi * 0.75f * (1.0f + cos_theta * cos_theta);
  // 1 + g^2 - 2 g cos, kept from cancelling near |g| = 1 in the lobe's middle; the mirrored g has the mirrored lobe.
  float a = abs(g);
  float d = (1.0f - a) * (1.0f - a) + 2.0f * a * (1.0f - (g < 0.0f ? -cos_theta : cos_theta));
  float hg = quarter_inverse_pi * (1.0f - g * g) / (d * sqrt(d));
  return kind == 0 ? hg : hg * 1.5f * (1.0f + cos_theta * cos_theta) / (2.0f + g * g);
}

// A segment of a ray, metres from the eye; empty where y <= x.
vec2 intersect(vec2 a, vec2 b) {
  return vec2(max(a.x, b.x), min(a.y, b.y));
}

// Where origin + t * direction is between low and high along one axis.
vec2 slab(float origin, float direction, float low, float high) {
  if (abs(direction) < 1e-9f) return origin >= low && origin <= high ? vec2(-1e20f, 1e20f) : vec2(1.0f, 0.0f);
  float a = (low - origin) / direction;
  float b = (high - origin) / direction;
  return vec2(min(a, b), max(a, b));
}

vec2 box_segment(vec3 origin, vec3 direction, vec3 low, vec3 high) {
  return intersect(intersect(slab(origin.x, direction.x, low.x, high.x), slab(origin.y, direction.y, low.y, high.y)),
                   slab(origin.z, direction.z, low.z, high.z));
}

// Length of the sun's path inside a box to origin + t * direction is min over three axes of line_a + line_b * t: the
// distance to the face through which the light came.
void sun_path_lines(vec3 origin, vec3 direction, vec3 low, vec3 high, vec3 sun, OUT(vec3) line_a, OUT(vec3) line_b) {
  for (int i = 0; i < 3; ++i) {
    bool across = abs(sun[i]) < 1e-5f;  // the light runs along these faces and never comes through them
    line_a[i] = across ? 1e9f : ((sun[i] > 0.0f ? high[i] : low[i]) - origin[i]) / sun[i];
    line_b[i] = across ? 0.0f : -direction[i] / sun[i];
  }
}

float sun_path(vec3 line_a, vec3 line_b, float t) {
  vec3 path = line_a + line_b * t;
  return max(min(path.x, min(path.y, path.z)), 0.0f);
}

float crossing(float a0, float b0, float a1, float b1, vec2 segment) {
  float difference = b1 - b0;
  float t = abs(difference) < 1e-9f ? segment.x : (a0 - a1) / difference;
  return clamp(t, segment.x, segment.y);
}

// Integral over the segment of extinction * exp(-extinction * (t - entry + sun's path)) dt: what arrives from the sun
// and goes on to where the ray enters the box, at `entry`. Exact: the path is linear between the lines' crossings.
float bounded_fraction(float extinction, vec2 segment, float entry, vec3 line_a, vec3 line_b) {
  if (segment.y <= segment.x) return 0.0f;
  float c0 = crossing(line_a.x, line_b.x, line_a.y, line_b.y, segment);
  float c1 = crossing(line_a.y, line_b.y, line_a.z, line_b.z, segment);
  float c2 = crossing(line_a.z, line_b.z, line_a.x, line_b.x, segment);
  float first = min(c0, min(c1, c2));
  float last = max(c0, max(c1, c2));
  float middle = max(min(c0, c1), min(max(c0, c1), c2));
  float sum = 0.0f;
  float from = segment.x;
  float path_from = sun_path(line_a, line_b, from);
  for (int i = 0; i < 4; ++i) {
    float to = i == 0 ? first : i == 1 ? middle : i == 2 ? last : segment.y;
    float path_to = sun_path(line_a, line_b, to);
    float size = max(to - from, 1e-9f);
    float part = attenuated_fraction(extinction, extinction * (from - entry + path_from),
                                     extinction * (1.0f + (path_to - path_from) / size), size);
    sum += to > from ? part : 0.0f;
    from = to;
    path_from = path_to;
  }
  return sum;
}

// The same for a medium without bounds, which takes the sun's light as given everywhere.
float unbounded_fraction(float extinction, vec2 segment) {
  if (segment.y <= segment.x) return 0.0f;
  return exp(-extinction * segment.x) * scattered_fraction(extinction * (segment.y - segment.x));
}
