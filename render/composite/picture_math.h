#pragma once

#include <glm/glm.hpp>

#include "render/base/picture.h"

namespace render {

// Affine step between code values (planes 0, 1, 2 as integers: Y Cb Cr, or G B R) and non-linear RGB, 0 to 1:
// rgb = matrix * code + offset. ITU-R BT.601-7, BT.709-6, BT.2020-2 (non-constant luminance) and H.273 8.3.
struct CodeTransform {
  glm::dmat3 matrix{1.0};
  glm::dvec3 offset{0.0};
};
CodeTransform rgb_from_code(const PictureFormat& format);
CodeTransform code_from_rgb(const PictureFormat& format);

// Codes that a picture may hold: limited range keeps clear of the timing references (0 and the highest).
struct CodeLimits {
  int min = 0;
  int max = 255;
};
CodeLimits code_limits(const PictureFormat& format);

// Linear light from and to coded values (0 to 1), the same code as the shaders'. Pq and Hlg throw std::runtime_error.
glm::vec3 linear_from_coded(Transfer transfer, const glm::vec3& coded);
glm::vec3 coded_from_linear(Transfer transfer, const glm::vec3& linear);

// The highlight shoulder (shaders/lib/shoulder.glsl) and its inverse.
glm::vec3 shoulder(const glm::vec3& linear);
glm::vec3 shoulder_inverse(const glm::vec3& shown);

// Dither of that pixel in (-0.5, 0.5) output steps (shaders/lib/dither.glsl).
float dither(const glm::vec2& pixel);

// Linear light in BT.2020 primaries from Rec. 709 primaries (ITU-R BT.2087-0, equation of annex 1).
glm::dmat3 bt2020_from_709();

}  // namespace render
