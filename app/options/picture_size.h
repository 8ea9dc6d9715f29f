#pragma once

#include <string>

namespace app {

struct PictureSize {
  int width = 0;
  int height = 0;
};

// Of a picture that is made or asked of a camera, pixels.
inline constexpr int kLargestSide = 16384;

// "1280x720", each side 1 to kLargestSide. Throws UsageError that names the option.
PictureSize parse_picture_size(const std::string& option, const std::string& text);

}  // namespace app
