#include "render/sky/preetham.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/base/check.h"

namespace render {
namespace {

double held_turbidity(double turbidity) {
  return std::clamp(turbidity, 1.7, 10.0);
}

double cubic(double t, double k3, double k2, double k1, double k0) {
  return ((k3 * t + k2) * t + k1) * t + k0;
}

}  // namespace

PreethamShapes preetham_shapes(double turbidity) {
  CHECK(turbidity > 0.0);
  const double t = held_turbidity(turbidity);
  PreethamShapes shapes;
  shapes.luminance = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                      -0.0670 * t + 0.3703};
  shapes.x = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
              -0.0033 * t + 0.0452};
  shapes.y = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
              -0.0109 * t + 0.0529};
  return shapes;
}

PreethamZenith preetham_zenith(double turbidity, double sun_zenith_rad) {
  CHECK(turbidity > 0.0);
  CHECK(std::isfinite(sun_zenith_rad));
  const double t = held_turbidity(turbidity);
  const double zenith = std::clamp(sun_zenith_rad, 0.0, std::numbers::pi / 2.0);
  const double chi = (4.0 / 9.0 - t / 120.0) * (std::numbers::pi - 2.0 * zenith);
  PreethamZenith values;
  values.luminance_kcdm2 = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
  values.x = t * t * cubic(zenith, 0.00166, -0.00375, 0.00209, 0.0) +
             t * cubic(zenith, -0.02903, 0.06377, -0.03202, 0.00394) +
             cubic(zenith, 0.11693, -0.21196, 0.06052, 0.25886);
  values.y = t * t * cubic(zenith, 0.00275, -0.00610, 0.00317, 0.0) +
             t * cubic(zenith, -0.04214, 0.08970, -0.04153, 0.00516) +
             cubic(zenith, 0.15346, -0.26756, 0.06670, 0.26688);
  return values;
}

}  // namespace render
