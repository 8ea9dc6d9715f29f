#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "render/base/pixel_format.h"

namespace ar {

// What the samples of a frame mean.
using render::Chroma;
using render::ChromaSiting;
using render::ColorMatrix;
using render::ColorRange;
using render::Transfer;
enum class Primaries { Unknown, Bt709, Bt601_525, Bt601_625, Bt2020, DisplayP3 };

struct ColorInfo {
  ColorMatrix matrix = ColorMatrix::Unknown;
  ColorRange range = ColorRange::Unknown;
  Transfer transfer = Transfer::Unknown;
  Primaries primaries = Primaries::Unknown;
  ChromaSiting siting = ChromaSiting::Unknown;
  bool operator==(const ColorInfo&) const = default;
};

// How a stream names its colours, in the code points of ITU-T H.273 (2 or 0: unspecified), which containers, codecs
// and FFmpeg's AVCOL_* share. Kept beside ColorInfo so that what goes out is tagged exactly as what came in.
struct ColorTags {
  int primaries = 2;
  int transfer = 2;
  int matrix = 2;
  int range = 0;   // FFmpeg's AVColorRange: 0 unspecified, 1 limited, 2 full
  int siting = 0;  // FFmpeg's AVChromaLocation: 0 unspecified, 1 left, 2 center, 3 top left
  bool operator==(const ColorTags&) const = default;
};

struct PixelFormat {
  int width = 0;  // upright, after the rotation metadata was applied
  int height = 0;
  int bit_depth = 8;  // 8, or 10 in little-endian 16-bit words, value in the low bits
  Chroma chroma = Chroma::C420;
  ColorInfo color;
  bool operator==(const PixelFormat&) const = default;
};

// Exposure as the camera tells it, where it does.
struct ExposureInfo {
  std::optional<double> exposure_s;
  std::optional<double> iso;
  std::optional<double> f_number;
  std::optional<double> gain;                 // analogue times digital, 1: none
  std::optional<double> color_temperature_k;  // that the camera balanced its colours for
  std::optional<double> lux;                  // its own estimate of the light on the scene
};

// One upright picture: three planes (Y, Cb, Cr; or G, B, R where color.matrix is Rgb), row 0 at the top. Moves
// between stages; the pixels belong to `owner` (a decoder's or a camera's buffer on loan) and are never copied.
struct Frame {
  PixelFormat format;
  std::array<const std::uint8_t*, 3> plane{};
  std::array<std::ptrdiff_t, 3> stride_bytes{};
  std::shared_ptr<const void> owner;

  std::int64_t index = 0;  // 0, 1, 2 ... in the order of presentation
  std::int64_t pts = 0;    // in the source's time base
  double time_s = 0.0;     // pts in seconds
  double duration_s = 0.0;
  ExposureInfo exposure;

  Frame() = default;
  Frame(Frame&&) = default;
  Frame& operator=(Frame&&) = default;
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;
};

}  // namespace ar
