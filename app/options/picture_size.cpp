#include "app/options/picture_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "app/error.h"
#include "render/base/number.h"

namespace app {

PictureSize parse_picture_size(const std::string& option, const std::string& text) {
  const std::string_view all(text);
  const std::size_t x = std::min(all.find('x'), all.size());
  const auto width = render::parse_count<int>(all.substr(0, x));
  const auto height = render::parse_count<int>(all.substr(std::min(x + 1, all.size())));
  const auto fits = [](std::optional<int> side) { return side && *side >= 1 && *side <= kLargestSide; };
  if (!fits(width) || !fits(height)) {
    throw UsageError(
        fmt::format("{}: found '{}'; accepted: WIDTHxHEIGHT in pixels, each 1 to {}", option, text, kLargestSide));
  }
  return {*width, *height};
}

}  // namespace app
