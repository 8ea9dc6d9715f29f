#include "app/options/picture_size.h"

#include <cstdio>

#include "app/error.h"

namespace app {

PictureSize parse_picture_size(const std::string& option, const std::string& text) {
  PictureSize size;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest) != 2 || size.width < 1 ||
      size.height < 1) {
    throw UsageError(option + ": found '" + text + "'; accepted: WIDTHxHEIGHT, pixels, as 1280x720");
  }
  return size;
}

}  // namespace app
