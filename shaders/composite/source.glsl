// The source picture's planes, read as code values. Needs CHROMA (420, 422, 444), BIT_DEPTH, SITING_X and SITING_Y
// (0: chroma samples on even luma columns / rows, 1: half way between the two).

#if BIT_DEPTH > 8
uniform highp usampler2D source_y;
uniform highp usampler2D source_cb;
uniform highp usampler2D source_cr;
#define CODE(plane, at) float(texelFetch(plane, at, 0).r)
#else
uniform highp sampler2D source_y;
uniform highp sampler2D source_cb;
uniform highp sampler2D source_cr;
#define CODE(plane, at) (texelFetch(plane, at, 0).r * 255.0)
#endif

uniform ivec2 picture_last;  // last column and row of the picture
uniform ivec2 chroma_last;   // last column and row of the chroma planes

float luma_code(ivec2 pixel) { return CODE(source_y, pixel); }

vec2 chroma_code(ivec2 sample_at) {
  ivec2 at = clamp(sample_at, ivec2(0), chroma_last);
  return vec2(CODE(source_cb, at), CODE(source_cr, at));
}

// Weights of chroma samples n - 1, n, n + 1 for the luma column (or row) 2 n + odd.
vec3 upsampling_weights(int odd, int siting) {
  if (siting == 0) return odd == 0 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.5, 0.5);
  return odd == 0 ? vec3(0.25, 0.75, 0.0) : vec3(0.0, 0.75, 0.25);
}
