#include "app/report/thumbnail.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "render/images/image_codec.h"

namespace app {
namespace {

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < left ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= left ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

}  // namespace

render::Image thumbnail(const render::Image& image, int widest_px) {
  const int step = (image.width + widest_px - 1) / widest_px;
  if (step <= 1) return image;
  render::Image out{std::max(1, image.width / step), std::max(1, image.height / step), {}};
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      std::array<int, 4> sum{};
      int count = 0;
      for (int j = y * step; j < std::min((y + 1) * step, image.height); ++j) {
        for (int i = x * step; i < std::min((x + 1) * step, image.width); ++i, ++count) {
          const auto at = 4U * static_cast<std::size_t>(j * image.width + i);
          for (std::size_t c = 0; c < 4; ++c) sum[c] += image.rgba[at + c];
        }
      }
      for (const int value : sum) out.rgba.push_back(static_cast<std::uint8_t>((value + count / 2) / count));
    }
  }
  return out;
}

std::string data_uri(const render::Image& image) {
  constexpr int kQuality = 88;
  return "data:image/jpeg;base64," + base64(render::encode_jpeg(image, kQuality));
}

}  // namespace app
