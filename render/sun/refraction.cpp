#include "render/sun/refraction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/base/angles.h"
#include "render/base/check.h"

namespace render {
namespace {

constexpr double kFormulaFloorDeg = -1.0;  // the formula peaks at -1.90 degrees and has a pole at -5.11
constexpr double kFadedOutDeg = -3.5;      // far enough that the fade's slope stays below 1 in any weather

double saemundsson_deg(double elevation_deg) {
  return 1.02 / 60.0 / std::tan((elevation_deg + 10.3 / (elevation_deg + 5.11)) * kRadPerDeg);
}

double smooth_step(double edge0, double edge1, double x) {
  const double t = std::clamp((x - edge0) / (edge1 - edge0), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

double apparent_elevation(double elevation_rad, const Weather& weather) {
  CHECK(std::isfinite(elevation_rad));
  CHECK(weather.pressure_hpa >= 0.0);
  CHECK(weather.temperature_c > -273.0);
  const double elevation_deg = elevation_rad / kRadPerDeg;
  const double air_density = weather.pressure_hpa / 1010.0 * 283.0 / (273.0 + weather.temperature_c);
  const double lift_deg = saemundsson_deg(std::max(elevation_deg, kFormulaFloorDeg)) *
                          smooth_step(kFadedOutDeg, kFormulaFloorDeg, elevation_deg);
  return elevation_rad + std::max(lift_deg, 0.0) * air_density * kRadPerDeg;
}

}  // namespace render
