#pragma once

#include <cstdint>

namespace render {

inline constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;  // of a picture that is read

}  // namespace render
