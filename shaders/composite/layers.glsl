// What is laid over the real picture: out = real * keep + add, in display-linear light.
// OBJECTS: M and A of the objects pass. SHAFTS: T and L. LENS: both are looked up through the lens map.

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

// Joint bilateral upsampling (Kopf et al. 2007) of the 2 x 2 nearest: bilinear weights, lowered where the sample's
// inverse distance differs from the pixel's. The floor keeps a sum > 0 where none agrees.
vec4 shafts_at(vec2 ideal_uv, float inverse_distance) {
  const float kTolerance2 = 1e-3;  // squared relative difference at which a sample counts half
  vec2 at = ideal_uv * shafts_size - 0.5;
  vec2 base = floor(at);
  vec2 f = at - base;
  ivec2 last = ivec2(shafts_size) - 1;
  ivec2 a = clamp(ivec2(base), ivec2(0), last);
  ivec2 b = clamp(ivec2(base) + 1, ivec2(0), last);
  vec4 z = vec4(texelFetch(shafts_distance, a, 0).r, texelFetch(shafts_distance, ivec2(b.x, a.y), 0).r,
                texelFetch(shafts_distance, ivec2(a.x, b.y), 0).r, texelFetch(shafts_distance, b, 0).r);
  vec4 inverse = 1.0 / z;
  vec4 difference = (inverse - inverse_distance) / max(max(inverse, vec4(inverse_distance)), vec4(1e-9));
  vec4 weight = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y) /
                (kTolerance2 + difference * difference);
  vec4 sum = weight.x * texelFetch(shafts, a, 0) + weight.y * texelFetch(shafts, ivec2(b.x, a.y), 0) +
             weight.z * texelFetch(shafts, ivec2(a.x, b.y), 0) + weight.w * texelFetch(shafts, b, 0);
  return sum / dot(weight, vec4(1.0));
}
#endif

#ifdef WIDE_GAMUT
uniform mat3 picture_from_709;
#endif

Layers layers_at(ivec2 pixel) {
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
#ifdef SHAFTS
#ifdef LENS
  ivec2 ideal_pixel = ivec2(uv * ideal_size);
#else
  vec2 uv = (vec2(pixel) + 0.5) / ideal_size;
  ivec2 ideal_pixel = pixel;
#endif
#ifdef OBJECTS
  float inverse_distance = (1.0 - texelFetch(ideal_depth, ideal_pixel, 0).r) / near_m;
#else
  float inverse_distance = 0.0;
#endif
  vec4 air = shafts_at(uv, inverse_distance);
  layers.keep *= air.a;
  layers.add = layers.add * air.a + air.rgb;
#endif
#ifdef WIDE_GAMUT
  layers.add = picture_from_709 * layers.add;
#endif
  return layers;
}
