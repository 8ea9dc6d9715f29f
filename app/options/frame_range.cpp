#include "app/options/frame_range.h"

#include <fmt/format.h>

#include <string_view>

#include "app/error.h"
#include "render/base/number.h"

namespace app {
namespace {

[[noreturn]] void refuse(const std::string& text) {
  throw UsageError(fmt::format(
      "--frames: found '{}'; accepted: FIRST:END, frames counted from 0, END not included, either may be left out",
      text));
}

}  // namespace

FrameRange parse_frame_range(const std::string& text) {
  const auto colon = text.find(':');
  if (colon == std::string::npos) refuse(text);
  const auto parse = [&text](std::string_view digits, std::int64_t otherwise) {
    if (digits.empty()) return otherwise;
    const auto value = render::parse_count<std::int64_t>(digits);
    if (!value) refuse(text);
    return *value;
  };
  const std::string_view view(text);
  FrameRange range;
  range.first = parse(view.substr(0, colon), range.first);
  range.end = parse(view.substr(colon + 1), range.end);
  if (range.first >= range.end) refuse(text);
  return range;
}

}  // namespace app
