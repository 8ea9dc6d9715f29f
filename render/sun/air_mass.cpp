#include "render/sun/air_mass.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/base/check.h"

namespace render {

double relative_air_mass(double elevation_rad) {
  CHECK(std::isfinite(elevation_rad));
  constexpr double kDegPerRad = 180.0 / std::numbers::pi;
  const double elevation_deg = std::max(elevation_rad * kDegPerRad, 0.0);
  return 1.0 / (std::sin(elevation_deg / kDegPerRad) + 0.50572 * std::pow(elevation_deg + 6.07995, -1.6364));
}

}  // namespace render
