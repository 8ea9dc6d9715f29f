#include "ar/capture/color/orientation.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace ar {

int Orientation::rotation_deg() const {
  if (transpose) return flip_x ? 90 : 270;
  return flip_y ? 180 : 0;
}

std::string Orientation::filters() const {
  if (transpose) {
    if (flip_x && flip_y) return "transpose=clock_flip";
    if (flip_x) return "transpose=clock";
    if (flip_y) return "transpose=cclock";
    return "transpose=cclock_flip";
  }
  // vflip only reverses the strides; the filter after it writes rows from the top again, as Frame promises.
  if (flip_x && flip_y) return "vflip,hflip";
  if (flip_x) return "hflip";
  if (flip_y) return "vflip,copy";
  return {};
}

Orientation orientation_from_matrix(const std::int32_t matrix[9], bool* exact) {
  const double a = matrix[0];
  const double b = matrix[1];
  const double c = matrix[3];
  const double d = matrix[4];
  const double straight = std::abs(a) + std::abs(d);
  const double crossed = std::abs(b) + std::abs(c);
  // A hundredth: cameras round their matrices, people do not tilt pictures by half a degree.
  if (exact != nullptr) *exact = std::min(straight, crossed) <= 0.01 * std::max(straight, crossed);
  if (straight >= crossed) return {false, a < 0, d < 0};
  return {true, c < 0, b < 0};
}

ChromaSiting siting_after(const Orientation& orientation, ChromaSiting siting) {
  const bool same_x = !orientation.transpose && !orientation.flip_x;
  if (siting == ChromaSiting::Left) return same_x ? siting : ChromaSiting::Center;
  if (siting == ChromaSiting::TopLeft) {
    return !orientation.flip_x && !orientation.flip_y ? siting : ChromaSiting::Center;
  }
  return siting;
}

}  // namespace ar
