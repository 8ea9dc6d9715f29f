#version 310 es
// Lays objects and medium over the real picture in linear light and encodes the result as the source is encoded. One
// fragment makes a block of pixels (BLOCK_W wide; two rows in 4:2:0), because the targets hold packed bytes: RGBA8 is
// what every GLES can render to and read back. Targets: 4:2:0: luma of the upper row, of the lower row, chroma;
// 4:2:2: luma, chroma; 4:4:4: one a plane. Chroma texels hold Cb's bytes, then Cr's.
// Numbers that come as #define: BIT_DEPTH 8 or 10, CHROMA 420, 422 or 444, SITING_X and SITING_Y (source.glsl),
// TRANSFER 0 BT.709, 1 sRGB, 2 linear, 3 power GAMMA.
//
precision highp float;
precision highp int;

#include "lib/transfer.glsl"
#include "lib/shoulder.glsl"
#include "lib/dither.glsl"
#include "composite/source.glsl"
#include "composite/layers.glsl"

layout(location = 0) out vec4 target0;
layout(location = 1) out vec4 target1;
layout(location = 2) out vec4 target2;

uniform mat3 rgb_from_code;
uniform vec3 rgb_offset;  // rgb = rgb_from_code * code + rgb_offset
uniform mat3 code_from_rgb;
uniform vec3 code_offset;
uniform float code_min;  // codes that may be written
uniform float code_max;

#if TRANSFER == 0
#define LINEAR_FROM_CODED(v) bt709_linear_from_coded(v)
#define CODED_FROM_LINEAR(v) bt709_coded_from_linear(v)
#elif TRANSFER == 1
#define LINEAR_FROM_CODED(v) srgb_linear_from_coded(v)
#define CODED_FROM_LINEAR(v) srgb_coded_from_linear(v)
#elif TRANSFER == 2
#define LINEAR_FROM_CODED(v) (v)
#define CODED_FROM_LINEAR(v) (v)
#else
#define LINEAR_FROM_CODED(v) gamma_linear_from_coded(v, GAMMA)
#define CODED_FROM_LINEAR(v) gamma_coded_from_linear(v, GAMMA)
#endif

// Blocks start on even columns, and on even rows where they have two.
#if CHROMA == 420
#define BLOCK_H 2
#define PARITY(origin) ivec2(0)
#else
#define BLOCK_H 1
#define PARITY(origin) ivec2(0, (origin).y & 1)
#endif

struct Pixel {
  vec3 code;    // composited code values, not yet rounded
  float kept;   // how much of the real picture's coded detail is left, [0, 1]
};

Pixel composite_pixel(ivec2 origin, ivec2 offset, ivec2 pixel, vec3 source_code) {
  Layers layers = layers_at(pixel, origin, offset, PARITY(origin));
  vec3 shown = LINEAR_FROM_CODED(rgb_from_code * source_code + rgb_offset);
  vec3 light = shoulder_inverse(shown) * layers.keep + layers.add;
  // Only what the source itself holds beyond white may go beyond white.
  vec3 result = min(shoulder(light), max(shown, vec3(1.0)));
  vec3 code = code_from_rgb * CODED_FROM_LINEAR(result) + code_offset;
  bool untouched = layers.keep == vec3(1.0) && layers.add == vec3(0.0);
  // A coded value changes about as the square root of its light.
  float kept = sqrt(clamp(dot(layers.keep, vec3(0.2126, 0.7152, 0.0722)), 0.0, 1.0));
  return Pixel(untouched ? source_code : code, untouched ? 1.0 : kept);
}

// Dither stays below half a step, so that a value that is a whole number already stays what it is.
float rounded_code(float code, vec2 pixel) {
  return clamp(floor(code + 0.5 + 0.96 * dither(pixel)), code_min, code_max);
}

#if BIT_DEPTH > 8
#define BLOCK_W 2
// Little-endian 16-bit words: two to a texel.
vec4 packed_texel(vec4 codes) {
  vec2 high = floor(codes.xy / 256.0);
  vec2 low = codes.xy - 256.0 * high;
  return vec4(low.x, high.x, low.y, high.y) / 255.0;
}
vec4 packed_chroma(vec4 cb, vec4 cr) { return packed_texel(vec4(cb.x, cr.x, 0.0, 0.0)); }
#else
#define BLOCK_W 4
vec4 packed_texel(vec4 codes) { return codes / 255.0; }
vec4 packed_chroma(vec4 cb, vec4 cr) { return vec4(cb.xy, cr.xy) / 255.0; }
#endif

#if CHROMA == 444

// Pixel `col` of the block; a literal, so that its place in the texels is known to the compiler.
#define ADD_PIXEL(col)                                                                                     \
  {                                                                                                        \
    ivec2 pixel = min(origin + ivec2(col, 0), picture_last);                                               \
    Pixel p = composite_pixel(origin, ivec2(col, 0), pixel, vec3(luma_code(pixel), chroma_code(pixel)));   \
    first[col] = rounded_code(p.code.x, vec2(pixel));                                                      \
    second[col] = rounded_code(p.code.y, vec2(pixel) + vec2(17.0, 5.0));                                   \
    third[col] = rounded_code(p.code.z, vec2(pixel) + vec2(5.0, 17.0));                                    \
  }

void main() {
  ivec2 origin = ivec2(gl_FragCoord.xy) * ivec2(BLOCK_W, 1);
  vec4 first = vec4(0.0);
  vec4 second = vec4(0.0);
  vec4 third = vec4(0.0);
  ADD_PIXEL(0)
  ADD_PIXEL(1)
#if BLOCK_W == 4
  ADD_PIXEL(2)
  ADD_PIXEL(3)
#endif
  target0 = packed_texel(first);
  target1 = packed_texel(second);
  target2 = packed_texel(third);
}

#else

// Co-sited chroma is filtered by 1 2 1 about its own column or row, so the pixel before the block counts too.
#define HALO_X (1 - SITING_X)
#if CHROMA == 420
#define HALO_Y (1 - SITING_Y)
#else
#define HALO_Y 0
#endif

float downsampling_weight(int distance_from_sample, int siting) {
  if (siting == 1) return distance_from_sample == 0 || distance_from_sample == 1 ? 0.5 : 0.0;
  return distance_from_sample == 0 ? 0.5 : (abs(distance_from_sample) == 1 ? 0.25 : 0.0);
}

// Chroma samples of the columns n - 1 to n + 2 at one luma row.
struct ChromaRow {
  vec2 s0, s1, s2, s3;
};

ChromaRow chroma_row(ivec2 n, int row) {
#if CHROMA == 420
  int centre = row < 0 ? n.y - 1 : n.y;
  vec3 w = upsampling_weights(row & 1, SITING_Y);
  ChromaRow r;
  r.s0 = w.y * chroma_code(ivec2(n.x - 1, centre));
  r.s1 = w.y * chroma_code(ivec2(n.x, centre));
  r.s2 = w.y * chroma_code(ivec2(n.x + 1, centre));
  r.s3 = w.y * chroma_code(ivec2(n.x + 2, centre));
  int other = (row & 1) == 0 ? centre - 1 : centre + 1;
  float v = w.x + w.z;
  r.s0 += v * chroma_code(ivec2(n.x - 1, other));
  r.s1 += v * chroma_code(ivec2(n.x, other));
  r.s2 += v * chroma_code(ivec2(n.x + 1, other));
  r.s3 += v * chroma_code(ivec2(n.x + 2, other));
  return r;
#else
  return ChromaRow(chroma_code(ivec2(n.x - 1, n.y)), chroma_code(n), chroma_code(ivec2(n.x + 1, n.y)),
                   chroma_code(ivec2(n.x + 2, n.y)));
#endif
}

// Chroma at column x (-1 to 3) of the block.
vec2 chroma_at(ChromaRow r, int x) {
  vec3 w = upsampling_weights(x & 1, SITING_X);
  if (x < 0) return w.x * r.s0 + w.y * r.s0 + w.z * r.s1;
  if (x < 2) return w.x * r.s0 + w.y * r.s1 + w.z * r.s2;
  return w.x * r.s1 + w.y * r.s2 + w.z * r.s3;
}

// Sums up one chroma sample: the mean of the composited pixels' chroma, plus what upsampling lost of the source's own
// sample as far as the source is still seen. Where nothing changed this is the source's sample exactly.
struct ChromaSum {
  vec2 code;
  float kept;
};

void add_to(inout ChromaSum sum, float weight, Pixel pixel, vec2 source_chroma) {
  sum.code += weight * (pixel.code.yz - pixel.kept * source_chroma);
  sum.kept += weight * pixel.kept;
}

vec2 finish(ChromaSum sum, ivec2 sample_at, vec2 dither_at) {
  vec2 code = sum.code + sum.kept * chroma_code(sample_at);
  return vec2(rounded_code(code.x, dither_at + vec2(17.0, 5.0)), rounded_code(code.y, dither_at + vec2(5.0, 17.0)));
}

// Pixel (col, row) of the block; both are literals, so that all that hangs on them is decided by the compiler.
#define ADD_PIXEL(col, row)                                                                             \
  {                                                                                                     \
    ivec2 pixel = clamp(origin + ivec2(col, row), ivec2(0), picture_last);                              \
    vec2 source_chroma = chroma_at(chroma, col);                                                        \
    Pixel p = composite_pixel(origin, ivec2(col, row), pixel, vec3(luma_code(pixel), source_chroma));   \
    if (col >= 0 && row == 0) upper[col >= 0 ? col : 0] = rounded_code(p.code.x, vec2(pixel));          \
    if (col >= 0 && row == 1) lower[col >= 0 ? col : 0] = rounded_code(p.code.x, vec2(pixel));          \
    add_to(left, weight_y * downsampling_weight(col, SITING_X), p, source_chroma);                      \
    if (BLOCK_W > 2) add_to(right, weight_y * downsampling_weight(col - 2, SITING_X), p, source_chroma); \
  }

#if SITING_X == 0
#define ADD_HALO(row) ADD_PIXEL(-1, row)
#else
#define ADD_HALO(row)
#endif
#if BIT_DEPTH > 8
#define ADD_PIXELS(row) ADD_HALO(row) ADD_PIXEL(0, row) ADD_PIXEL(1, row)
#else
#define ADD_PIXELS(row) ADD_HALO(row) ADD_PIXEL(0, row) ADD_PIXEL(1, row) ADD_PIXEL(2, row) ADD_PIXEL(3, row)
#endif
#define ADD_ROW(row)                                                            \
  {                                                                             \
    ChromaRow chroma = chroma_row(n, row);                                      \
    float weight_y = BLOCK_H == 1 ? 1.0 : downsampling_weight(row, SITING_Y);   \
    ADD_PIXELS(row)                                                             \
  }

void main() {
  ivec2 origin = ivec2(gl_FragCoord.xy) * ivec2(BLOCK_W, BLOCK_H);
  ivec2 n = ivec2(origin.x / 2, origin.y / BLOCK_H);
  vec4 upper = vec4(0.0);
  vec4 lower = vec4(0.0);
  ChromaSum left = ChromaSum(vec2(0.0), 0.0);
  ChromaSum right = ChromaSum(vec2(0.0), 0.0);
#if HALO_Y == 1
  ADD_ROW(-1)
#endif
  ADD_ROW(0)
#if BLOCK_H == 2
  ADD_ROW(1)
#endif
  vec2 at_left = finish(left, n, vec2(n));
  vec2 at_right = finish(right, n + ivec2(1, 0), vec2(n) + vec2(1.0, 0.0));
  target0 = packed_texel(upper);
  vec4 chroma = packed_chroma(vec4(at_left.x, at_right.x, 0.0, 0.0), vec4(at_left.y, at_right.y, 0.0, 0.0));
#if CHROMA == 420
  target1 = packed_texel(lower);
  target2 = chroma;
#else
  target1 = chroma;
  target2 = vec4(0.0);
#endif
}

#endif
