#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/sky/hemisphere.h"
#include "render/sky/sky_light.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

SunPosition sun_at(double azimuth_deg, double elevation_deg) {
  SunPosition sun;
  sun.azimuth_rad = azimuth_deg * kDeg;
  sun.elevation_rad = sun.apparent_elevation_rad = elevation_deg * kDeg;
  return sun;
}

TEST(SkyProperty, IsFiniteAndNotNegativeForEverySunTurbidityAndDirection) {
  for (const double turbidity : {1.0, 1.64, 2.0, 3.0, 6.0, 10.0, 20.0}) {
    for (const double elevation : {-90.0, -18.0, -6.0, -0.833, -1e-9, 0.0, 0.01, 3.0, 20.0, 60.0, 89.999, 90.0}) {
      const SunPosition sun = sun_at(123.0, elevation);
      const auto sky = make_sky({.model = "perez", .turbidity = turbidity}, sun);
      for (int i = 0; i < 400; ++i) {
        const double z = -1.0 + 2.0 * i / 399.0;
        const double radius = std::sqrt(1.0 - z * z);
        const glm::dvec3 view(radius * std::sin(2.4 * i), radius * std::cos(2.4 * i), z);
        const glm::dvec3 rgb = sky->luminance_rgb(view);
        for (int c = 0; c < 3; ++c) {
          ASSERT_TRUE(std::isfinite(rgb[c]) && rgb[c] >= 0.0)
              << "turbidity " << turbidity << " sun " << elevation << " z " << z << " value " << rgb[c];
        }
      }
      ASSERT_TRUE(std::isfinite(sky->luminance_rgb(sun.direction_in_world()).y));
    }
  }
}

}  // namespace
}  // namespace render
