#include "render/composite/picture_math.h"

#include <stdexcept>

#include "render/base/luminance.h"

namespace render {
namespace {

// The shaders' own functions, compiled by GLM.
namespace glsl {
using glm::abs;
using glm::clamp;
using glm::dot;
using glm::fract;
using glm::lessThan;
using glm::max;
using glm::min;
using glm::mix;
using glm::pow;
using glm::sign;
using glm::vec2;
using glm::vec3;
#include "shaders/lib/dither.glsl"
#include "shaders/lib/shoulder.glsl"
#include "shaders/lib/transfer.glsl"
}  // namespace glsl

// Luma weights of red and blue.
struct LumaWeights {
  double red;
  double blue;
};

LumaWeights luma_weights(ColorMatrix matrix) {
  switch (matrix) {
    case ColorMatrix::Bt601:
      return {0.299, 0.114};
    case ColorMatrix::Bt2020:
      return {0.2627, 0.0593};
    case ColorMatrix::Bt709:
    case ColorMatrix::Rgb:
    case ColorMatrix::Unknown:
      break;
  }
  return {kRec709Red, kRec709Blue};
}

// Rows Y', Cb, Cr over columns R', G', B'; Cb and Cr in [-0.5, 0.5].
glm::dmat3 ycc_from_rgb(ColorMatrix matrix) {
  const auto [kr, kb] = luma_weights(matrix);
  const glm::dvec3 y(kr, 1.0 - kr - kb, kb);
  const glm::dvec3 cb = (glm::dvec3(0.0, 0.0, 1.0) - y) / (2.0 * (1.0 - kb));
  const glm::dvec3 cr = (glm::dvec3(1.0, 0.0, 0.0) - y) / (2.0 * (1.0 - kr));
  return glm::transpose(glm::dmat3(y, cb, cr));
}

}  // namespace

CodeTransform code_from_rgb(const PictureFormat& format) {
  const double step = static_cast<double>(1 << (format.bit_depth - 8));
  const double full = static_cast<double>((1 << format.bit_depth) - 1);
  const bool limited = format.range == ColorRange::Limited;
  const double luma_scale = limited ? 219.0 * step : full;
  const double luma_zero = limited ? 16.0 * step : 0.0;
  if (format.matrix == ColorMatrix::Rgb) {
    const glm::dmat3 gbr_from_rgb(0, 0, 1, 1, 0, 0, 0, 1, 0);  // columns: where R, G and B go
    return {luma_scale * gbr_from_rgb, glm::dvec3(luma_zero)};
  }
  const double chroma_scale = limited ? 224.0 * step : full;
  const double chroma_zero = 128.0 * step;
  const glm::dmat3 scale(luma_scale, 0, 0, 0, chroma_scale, 0, 0, 0, chroma_scale);
  return {scale * ycc_from_rgb(format.matrix), {luma_zero, chroma_zero, chroma_zero}};
}

CodeTransform rgb_from_code(const PictureFormat& format) {
  const CodeTransform code = code_from_rgb(format);
  const glm::dmat3 inverse = glm::inverse(code.matrix);
  return {inverse, -(inverse * code.offset)};
}

CodeLimits code_limits(const PictureFormat& format) {
  const int last = (1 << format.bit_depth) - 1;
  if (format.range == ColorRange::Full || format.matrix == ColorMatrix::Rgb) return {0, last};
  const int reserved = 1 << (format.bit_depth - 8);
  return {reserved, last - reserved};
}

glm::vec3 linear_from_coded(Transfer transfer, const glm::vec3& coded) {
  switch (transfer) {
    case Transfer::Bt709:
      return glsl::bt709_linear_from_coded(coded);
    case Transfer::Srgb:
      return glsl::srgb_linear_from_coded(coded);
    case Transfer::Linear:
      return coded;
    case Transfer::Gamma22:
      return glsl::gamma_linear_from_coded(coded, 2.2F);
    case Transfer::Gamma28:
      return glsl::gamma_linear_from_coded(coded, 2.8F);
    case Transfer::Pq:
    case Transfer::Hlg:
    case Transfer::Unknown:
      break;
  }
  throw std::runtime_error("a picture with an HDR transfer function (PQ or HLG) cannot be composited; tone-map it");
}

glm::vec3 coded_from_linear(Transfer transfer, const glm::vec3& linear) {
  switch (transfer) {
    case Transfer::Bt709:
      return glsl::bt709_coded_from_linear(linear);
    case Transfer::Srgb:
      return glsl::srgb_coded_from_linear(linear);
    case Transfer::Linear:
      return linear;
    case Transfer::Gamma22:
      return glsl::gamma_coded_from_linear(linear, 2.2F);
    case Transfer::Gamma28:
      return glsl::gamma_coded_from_linear(linear, 2.8F);
    case Transfer::Pq:
    case Transfer::Hlg:
    case Transfer::Unknown:
      break;
  }
  throw std::runtime_error("a picture with an HDR transfer function (PQ or HLG) cannot be composited; tone-map it");
}

glm::vec3 shoulder(const glm::vec3& linear) {
  return glsl::shoulder(linear);
}
glm::vec3 shoulder_inverse(const glm::vec3& shown) {
  return glsl::shoulder_inverse(shown);
}
float dither(const glm::vec2& pixel) {
  return glsl::dither(pixel);
}

glm::dmat3 bt2020_from_709() {
  return glm::transpose(glm::dmat3(0.6274, 0.3293, 0.0433, 0.0691, 0.9195, 0.0114, 0.0164, 0.0880, 0.8956));
}

}  // namespace render
