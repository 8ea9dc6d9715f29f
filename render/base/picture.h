#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace render {

// What a video pixel means. `Rgb` is planar G, B, R (FFmpeg's gbrp order) with no matrix.
enum class ColorMatrix { Rgb, Bt601, Bt709, Bt2020 };
enum class ColorRange { Limited, Full };
// Transfer functions, decoded with the inverse of the tagged OETF (so that linear light is scene-like). Bt709 also
// serves BT.601 and BT.2020 SDR. Pq and Hlg are tone-mapped to SDR when they get here.
enum class Transfer { Bt709, Srgb, Linear, Gamma22, Gamma28, Pq, Hlg };
enum class Chroma { C420, C422, C444 };
enum class ChromaSiting { Left, Center, TopLeft };

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
