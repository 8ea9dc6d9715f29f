// What is laid over the real picture: out = real * keep + add, in display-linear light.
// OBJECTS: M and A of the objects pass. SHAFTS: T and L; SHAFTS_HALF where they are exactly half as wide and high as
// the picture, SHAFTS_WHOLE where they are as large. LENS (never with either): all are looked up through the lens map.

struct Layers {
  vec3 keep;  // M T
  vec3 add;   // A T + L
};

#ifdef OBJECTS
uniform highp sampler2D objects_added;
uniform highp sampler2D objects_multiplier;
#endif

#ifdef LENS
uniform highp sampler2D lens_map;  // ideal picture's coordinates, 0 to 1 from its top left; negative: none
#endif

#ifdef SHAFTS
uniform highp sampler2D shafts;           // rgb L, a T
uniform highp sampler2D shafts_distance;  // metres along the camera's axis
uniform highp sampler2D ideal_depth;      // window depth = 1 - near / z
uniform vec2 shafts_size;
uniform vec2 ideal_size;
uniform float near_m;

// Joint bilateral upsampling (Kopf et al. 2007) of the 2 x 2 nearest samples, `at` and the next along each axis:
// bilinear weights (part: how far past `at`), lowered where a sample's distance differs from the pixel's. The distance
// of nothing at all must be finite.
vec4 upsampled(ivec2 at, vec2 part, float distance_m) {
  const float kTolerance2 = 1e-3;  // squared relative difference at which a sample counts half
  ivec2 last = ivec2(shafts_size) - 1;
  ivec2 a = clamp(at, ivec2(0), last);
  ivec2 b = clamp(at + 1, ivec2(0), last);
  vec4 inverse = 1.0 / vec4(texelFetch(shafts_distance, a, 0).r, texelFetch(shafts_distance, ivec2(b.x, a.y), 0).r,
                            texelFetch(shafts_distance, ivec2(a.x, b.y), 0).r, texelFetch(shafts_distance, b, 0).r);
  vec4 difference = distance_m * inverse - 1.0;
  vec4 bilinear = vec4((1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y,
                       part.x * part.y);
  vec4 weight = bilinear / (kTolerance2 + difference * difference);
  vec4 sum = weight.x * texelFetch(shafts, a, 0) + weight.y * texelFetch(shafts, ivec2(b.x, a.y), 0) +
             weight.z * texelFetch(shafts, ivec2(a.x, b.y), 0) + weight.w * texelFetch(shafts, b, 0);
  return sum / dot(weight, vec4(1.0));
}

#ifdef SHAFTS_HALF
// Exactly half the picture's size: neighbouring pixels share samples, which the compiler sees when they are counted
// from the block's own.
vec4 shafts_at(ivec2 origin, ivec2 offset, ivec2 parity, float distance_m) {
  ivec2 cell = offset + parity;
  vec2 part = vec2((cell.x & 1) == 0 ? 0.75 : 0.25, (cell.y & 1) == 0 ? 0.75 : 0.25);
  return upsampled((origin >> 1) + ((cell - 1) >> 1), part, distance_m);
}
#else
vec4 shafts_at(vec2 ideal_uv, float distance_m) {
  vec2 at = ideal_uv * shafts_size - 0.5;
  vec2 base = floor(at);
  return upsampled(ivec2(base), at - base, distance_m);
}
#endif
#endif

#ifdef WIDE_GAMUT
uniform mat3 picture_from_709;
#endif

// The layers of a pixel, which lies `offset` from `origin` (and may be clamped to the picture). `parity` is origin & 1,
// given apart because callers know it at compile time.
Layers layers_at(ivec2 pixel, ivec2 origin, ivec2 offset, ivec2 parity) {
  Layers layers = Layers(vec3(1.0), vec3(0.0));
#ifdef LENS
  vec2 uv = texelFetch(lens_map, pixel, 0).rg;
  if (uv.x < 0.0) return layers;
#endif
#ifdef OBJECTS
#ifdef LENS
  layers.keep = texture(objects_multiplier, uv).rgb;
  layers.add = texture(objects_added, uv).rgb;
#else
  layers.keep = texelFetch(objects_multiplier, pixel, 0).rgb;
  layers.add = texelFetch(objects_added, pixel, 0).rgb;
#endif
#endif
#if defined(SHAFTS_WHOLE)
  vec4 path = texelFetch(shafts, pixel, 0);
#elif defined(SHAFTS)
  float distance_m = 1e9;  // what shafts_distance says of the sky
#ifdef OBJECTS
#ifdef LENS
  ivec2 ideal_pixel = ivec2(uv * ideal_size);
#else
  ivec2 ideal_pixel = pixel;
#endif
  distance_m = near_m / max(1.0 - texelFetch(ideal_depth, ideal_pixel, 0).r, 1e-9 * near_m);
#endif
#ifdef SHAFTS_HALF
  vec4 path = shafts_at(origin, offset, parity, distance_m);
#elif defined(LENS)
  vec4 path = shafts_at(uv, distance_m);
#else
  vec4 path = shafts_at((vec2(pixel) + 0.5) / ideal_size, distance_m);
#endif
#endif
#ifdef SHAFTS
  layers.keep *= path.a;
  layers.add = layers.add * path.a + path.rgb;
#endif
#ifdef WIDE_GAMUT
  layers.add = picture_from_709 * layers.add;
#endif
  return layers;
}
