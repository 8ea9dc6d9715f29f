#pragma once

#include <limits>

namespace render {

inline constexpr double kEndless = std::numeric_limits<double>::infinity();

}  // namespace render
