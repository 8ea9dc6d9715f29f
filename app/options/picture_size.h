#pragma once

#include <string>

namespace app {

struct PictureSize {
  int width = 0;
  int height = 0;
};

// "1280x720". Throws UsageError that names the option.
PictureSize parse_picture_size(const std::string& option, const std::string& text);

}  // namespace app
