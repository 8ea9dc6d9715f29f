#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/composite/picture_math.h"

// What QuickComposite computes a pixel with: vectors of its three channels, and its transfer functions as tables. Here
// for the compiler to take into its loops.
namespace render::quick {

// GCC's portable vectors: SSE2 on every x86-64, NEON on ARM.
using Bytes8 = std::uint8_t __attribute__((vector_size(8)));
using Words8 = std::uint16_t __attribute__((vector_size(16)));
using Ints4 = std::int32_t __attribute__((vector_size(16)));
using Floats4 = float __attribute__((vector_size(16)));  // r, g, b and one of no meaning

inline Floats4 floats(const glm::vec3& v) {
  return Floats4{v.x, v.y, v.z, 0.0F};
}
inline std::array<Floats4, 3> columns(const glm::mat3& matrix) {
  return {floats(matrix[0]), floats(matrix[1]), floats(matrix[2])};
}
inline Floats4 lower(Floats4 a, Floats4 b) {
  return a < b ? a : b;
}
inline Floats4 higher(Floats4 a, Floats4 b) {
  return a > b ? a : b;
}

inline constexpr int kDitherSize = 64;
// Coded values from -1/4 to 5/4, which holds all that limited range can say.
inline constexpr int kDecodeSteps = 2048;
inline constexpr float kDecodeFrom = -0.25F;
inline constexpr float kDecodeTo = 1.25F;
// Light by the leading bits of its float: 64 steps an octave, from 2^-12 to 2^4.
inline constexpr int kEncodeShift = 17;
inline constexpr std::uint32_t kEncodeFirst = std::bit_cast<std::uint32_t>(0x1p-12F) >> kEncodeShift;
inline constexpr std::uint32_t kEncodeLast = std::bit_cast<std::uint32_t>(0x1p4F) >> kEncodeShift;

struct Step {
  float value;
  float slope;  // to the next
};

struct Tables {
  std::vector<float> decode;  // coded to linear light, the shoulder undone
  std::vector<Step> encode;   // and back, by the leading bits of the light
  std::vector<float> dither;

  explicit Tables(Transfer transfer) {
    for (int i = 0; i < kDecodeSteps; ++i) {
      const float coded = kDecodeFrom + (kDecodeTo - kDecodeFrom) * (static_cast<float>(i) + 0.5F) / kDecodeSteps;
      decode.push_back(shoulder_inverse(linear_from_coded(transfer, glm::vec3(coded))).x);
    }
    const auto coded_at = [&](std::uint32_t step) {
      return coded_from_linear(transfer, shoulder(glm::vec3(std::bit_cast<float>(step << kEncodeShift)))).x;
    };
    for (std::uint32_t i = kEncodeFirst; i <= kEncodeLast; ++i) {
      encode.push_back({coded_at(i), coded_at(i + 1) - coded_at(i)});
    }
    for (int y = 0; y < kDitherSize; ++y) {
      for (int x = 0; x < kDitherSize; ++x) dither.push_back(0.96F * render::dither(glm::vec2(x, y)));
    }
  }

  Floats4 linear(Floats4 coded) const {
    constexpr float kScale = kDecodeSteps / (kDecodeTo - kDecodeFrom);
    const Floats4 at = lower(higher((coded - kDecodeFrom) * kScale, Floats4{}), Floats4{} + (kDecodeSteps - 1.0F));
    const Ints4 i = __builtin_convertvector(at, Ints4);
    const float* table = decode.data();
    return Floats4{table[i[0]], table[i[1]], table[i[2]], 0.0F};
  }

  // Between two steps in a straight line. Light below the first step is as dark as that: half a code of eight bits.
  Floats4 coded(Floats4 light) const {
    const Floats4 kept = lower(higher(light, Floats4{} + 0x1p-12F), Floats4{} + 15.9F);
    const auto bits = std::bit_cast<Ints4>(kept);
    const Ints4 i = (bits >> kEncodeShift) - static_cast<std::int32_t>(kEncodeFirst);
    constexpr float kRest = 1.0F / static_cast<float>(1U << kEncodeShift);
    const Floats4 part = __builtin_convertvector(bits & ((1 << kEncodeShift) - 1), Floats4) * kRest;
    const Step* table = encode.data();
    const Step r = table[i[0]];
    const Step g = table[i[1]];
    const Step b = table[i[2]];
    return Floats4{r.value, g.value, b.value, 0.0F} + part * Floats4{r.slope, g.slope, b.slope, 0.0F};
  }
};

}  // namespace render::quick
