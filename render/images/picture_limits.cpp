#include "render/images/picture_limits.h"

#include <fmt/format.h>

#include <stdexcept>

namespace render {

void check_claimed_size(const char* what, std::int64_t width, std::int64_t height, std::uint64_t file_bytes,
                        std::uint64_t pixels_per_byte) {
  const auto refuse = [&](const std::string& limit) {
    throw std::runtime_error(fmt::format("{} of {} x {} pixels {}", what, width, height, limit));
  };
  if (width < 1 || height < 1) refuse("is empty");
  if (width > kMaxSide || height > kMaxSide) refuse(fmt::format("has a side of more than {} pixels", kMaxSide));
  if (width * height > kMaxPixels) refuse("is larger than 2^28 pixels");
  if (static_cast<std::uint64_t>(width * height) / pixels_per_byte > file_bytes) {
    refuse(fmt::format("cannot be in a file of {} bytes", file_bytes));
  }
}

}  // namespace render
