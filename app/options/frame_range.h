#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace app {

// Frames first <= index < end of a recording, counted from 0.
struct FrameRange {
  std::int64_t first = 0;
  std::int64_t end = std::numeric_limits<std::int64_t>::max();
};

// "100:250", "100:", ":250". Throws UsageError that says what was found and accepted.
FrameRange parse_frame_range(const std::string& text);

}  // namespace app
