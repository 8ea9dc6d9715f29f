#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace ar {

// What the samples of a frame mean. Unknown is a value; guess_color() in ar/capture/color/color.h is the one place that
// replaces it, and says so.
enum class ColorMatrix { Unknown, Rgb, Bt601, Bt709, Bt2020 };
enum class ColorRange { Unknown, Limited, Full };
enum class Transfer { Unknown, Bt709, Srgb, Linear, Gamma22, Gamma28, Pq, Hlg };
enum class Primaries { Unknown, Bt709, Bt601_525, Bt601_625, Bt2020, DisplayP3 };
enum class Chroma { C420, C422, C444 };
enum class ChromaSiting { Unknown, Left, Center, TopLeft };

struct ColorInfo {
  ColorMatrix matrix = ColorMatrix::Unknown;
  ColorRange range = ColorRange::Unknown;
  Transfer transfer = Transfer::Unknown;
  Primaries primaries = Primaries::Unknown;
  ChromaSiting siting = ChromaSiting::Unknown;
  bool operator==(const ColorInfo&) const = default;
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
