#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/base/pixel_format.h"

namespace render {

// Of a picture that is drawn on: nothing Unknown.
struct PictureFormat {
  int width = 0;
  int height = 0;
  int bit_depth = 8;  // 8: one byte a sample; 10: little-endian 16-bit words, value in the low bits
  Chroma chroma = Chroma::C420;
  ChromaSiting siting = ChromaSiting::Left;
  ColorMatrix matrix = ColorMatrix::Bt709;
  ColorRange range = ColorRange::Limited;
  Transfer transfer = Transfer::Bt709;

  bool operator==(const PictureFormat&) const = default;
};

// Borrowed planes, row 0 at the top.
struct PictureView {
  PictureFormat format;
  std::array<const std::uint8_t*, 3> plane{};
  std::array<std::ptrdiff_t, 3> stride_bytes{};
};
struct MutablePictureView {
  PictureFormat format;
  std::array<std::uint8_t*, 3> plane{};
  std::array<std::ptrdiff_t, 3> stride_bytes{};
};

}  // namespace render
