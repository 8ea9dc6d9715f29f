#include "app/live/held_mark.h"

#include <algorithm>
#include <cstring>

namespace app {
namespace {

void set_sample(ar::OutputFrame& frame, std::size_t plane, int x, int y, unsigned value) {
  std::uint8_t* row = frame.plane[plane] + y * frame.stride_bytes[plane];
  if (frame.format.bit_depth == 8) {
    row[x] = static_cast<std::uint8_t>(value);
  } else {
    const auto word = static_cast<std::uint16_t>(value * 4);
    std::memcpy(row + std::ptrdiff_t{2} * x, &word, sizeof word);
  }
}

}  // namespace

void mark_as_held(ar::OutputFrame& frame) {
  const int width = frame.format.width;
  const int height = frame.format.height;
  const int stripe = std::max(2, height / 45);
  const bool limited = frame.format.color.range == ar::ColorRange::Limited;
  const unsigned black = limited ? 16 : 0;
  const unsigned white = limited ? 235 : 255;
  const std::size_t planes = frame.format.color.matrix == ar::ColorMatrix::Rgb ? 3 : 1;
  for (int y = 0; y < height; ++y) {
    const bool whole_row = y < stripe || y >= height - stripe;
    for (int x = 0; x < width; ++x) {
      if (!whole_row && x == stripe) x = std::max(x, width - stripe);
      const unsigned value = ((x + y) / stripe) % 2 == 0 ? black : white;
      for (std::size_t plane = 0; plane < planes; ++plane) set_sample(frame, plane, x, y, value);
    }
  }
}

}  // namespace app
