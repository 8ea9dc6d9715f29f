#pragma once

#include <algorithm>

namespace render {

// 0 below edge0, 1 above edge1, a cubic with level ends between them.
inline double smooth_step(double edge0, double edge1, double x) {
  const double t = std::clamp((x - edge0) / (edge1 - edge0), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace render
