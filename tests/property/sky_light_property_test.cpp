// Through the day's end and under clouds: what a sky gives does not jump, and is as much as was measured.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "render/sky/hemisphere.h"
#include "render/sky/moon.h"
#include "render/sky/sky_light.h"
#include "render/sky/sky_models.h"
#include "render/sky/twilight.h"
#include "render/sun/refraction.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDeg = kPi / 180.0;

SunPosition sun_at(double azimuth_deg, double elevation_deg) {
  SunPosition sun;
  sun.azimuth_rad = azimuth_deg * kDeg;
  sun.elevation_rad = elevation_deg * kDeg;
  sun.apparent_elevation_rad = apparent_elevation(sun.elevation_rad, {});
  return sun;
}

double total_lux(const SkyModel& sky, const SunPosition& sun, double turbidity) {
  const double direct = luminance(sun_light(sun, turbidity).illuminance_rgb);
  return luminance(horizontal_illuminance(sky)) + direct * std::max(std::sin(sun.apparent_elevation_rad), 0.0);
}

// edge cases 25, 26 and 28
TEST(SkyProperty, LevelAndColourAreContinuousThroughSunset) {
  double level_before = 0.0;
  glm::dvec2 color_before(0.0);
  for (double elevation = 16.0; elevation > -20.0; elevation -= 0.2) {
    const SunPosition sun = sun_at(200.0, elevation);
    const auto sky = make_sky({.turbidity = 3.0}, sun);
    const glm::dvec3 xyz = xyz_from_rgb(horizontal_illuminance(*sky));
    const double level = std::log(total_lux(*sky, sun, 3.0));
    const double denominator = xyz.x + 15.0 * xyz.y + 3.0 * xyz.z;
    const glm::dvec2 color(4.0 * xyz.x / denominator, 9.0 * xyz.y / denominator);
    if (level_before != 0.0) {
      const double usual =
          std::log(clear_illuminance_lux((elevation + 0.2) * kDeg) / clear_illuminance_lux(elevation * kDeg));
      if (elevation > -13.0) {
        EXPECT_NEAR(level_before - level, usual, 0.02) << elevation;
      } else {  // airglow slows the fall
        EXPECT_GT(level_before - level, 0.0) << elevation;
        EXPECT_LT(level_before - level, usual + 0.02) << elevation;
      }
      EXPECT_LT(glm::length(color - color_before), 0.004) << elevation;
    }
    level_before = level;
    color_before = color;
  }
}

TEST(SkyProperty, ClearDayAndTwilightHaveTheObservatorysIlluminance) {
  for (double elevation = -12.0; elevation <= 60.0; elevation += 1.0) {
    const SunPosition sun = sun_at(100.0, elevation);
    const auto sky = make_sky({}, sun);
    EXPECT_NEAR(total_lux(*sky, sun, kClearTurbidity) / clear_illuminance_lux(sun.elevation_rad), 1.0, 0.2)
        << elevation;
  }
}

TEST(SkyProperty, TwilightIsBluerThanDaylightAndNightIsNot) {
  const auto chromaticity_x = [](double elevation) {
    const glm::dvec3 xyz = xyz_from_rgb(horizontal_illuminance(*make_sky({}, sun_at(0.0, elevation))));
    return xyz.x / (xyz.x + xyz.y + xyz.z);
  };
  EXPECT_LT(chromaticity_x(-6.0), 0.26);  // measured: 0.24
  EXPECT_GT(chromaticity_x(-40.0), 0.33);
}

// edge case 27
TEST(SkyProperty, MoonlessNightHasItsFloorAndTheMoonAddsToIt) {
  const SunPosition sun = sun_at(0.0, -40.0);
  SkyOptions options;
  EXPECT_NEAR(luminance(horizontal_illuminance(*make_sky(options, sun))), 8e-4, 2e-4);
  options.moon = MoonPosition{2.0, 1.2, 1.2, 3.8e8, 0.05, 1.0};
  const double full = luminance(horizontal_illuminance(*make_sky(options, sun)));
  const double direct = luminance(moon_illuminance_rgb(*options.moon, 3.0)) * std::sin(1.2);
  EXPECT_NEAR(full + direct, 0.25, 0.06);
  options.moon->elevation_rad = options.moon->apparent_elevation_rad = -0.1;
  EXPECT_NEAR(luminance(horizontal_illuminance(*make_sky(options, sun))), 8e-4, 2e-4);
  EXPECT_EQ(moon_illuminance_rgb(*options.moon, 3.0), glm::dvec3(0.0));
}

// edge case 29
TEST(SkyProperty, DirectBeamFadesWithTheDiscAndTheMoonIsAMillionthOfIt) {
  double before = 1e9;
  for (double elevation = 2.0; elevation > -1.5; elevation -= 0.02) {
    const double lux = luminance(sun_light(sun_at(0.0, elevation), 3.0).illuminance_rgb);
    ASSERT_LE(lux, before) << elevation;
    before = lux;
  }
  EXPECT_EQ(before, 0.0);
  const MoonPosition full{0.0, 1.0, 1.0, 3.8e8, 0.0, 1.0};
  EXPECT_GT(moon_to_sun(full), 1e-6);
  EXPECT_LT(moon_to_sun(full), 1e-5);
}

TEST(CloudProperty, SameSeedAndTimeGiveTheSameSkyOthersDoNot) {
  const SunPosition sun = sun_at(150.0, 35.0);
  const auto cloudy = [&](double time_s, std::uint32_t seed) {
    SkyOptions options;
    options.clouds = {"cloudy", time_s, seed};
    return make_sky(options, sun);
  };
  const auto once = cloudy(100.0, 3);
  const auto again = cloudy(100.0, 3);
  const auto later = cloudy(160.0, 3);
  const auto other = cloudy(100.0, 4);
  int changed_by_time = 0;
  int changed_by_seed = 0;
  for (const SolidAngleSample& sample : upper_hemisphere()) {
    const glm::dvec3 rgb = once->luminance_rgb(sample.direction_in_world);
    ASSERT_EQ(rgb, again->luminance_rgb(sample.direction_in_world));
    changed_by_time += rgb != later->luminance_rgb(sample.direction_in_world);
    changed_by_seed += rgb != other->luminance_rgb(sample.direction_in_world);
  }
  EXPECT_GT(changed_by_time, 500);
  EXPECT_GT(changed_by_seed, 500);
}

TEST(CloudProperty, CloudsPassBeforeTheSunSmoothlyAndOvercastHidesIt) {
  const SunPosition sun = sun_at(150.0, 35.0);
  const auto through = [&](const char* preset, double time_s) {
    SkyOptions options;
    options.clouds = {preset, time_s, 1};
    return make_sky(options, sun)->transmittance(sun.apparent_direction_in_world());
  };
  double least = 1.0;
  double most = 0.0;
  for (double time_s = 0.0; time_s < 3600.0; time_s += 60.0) {
    const double now = through("light", time_s);
    least = std::min(least, now);
    most = std::max(most, now);
    EXPECT_LT(std::abs(through("light", time_s + 0.04) - now), 0.1) << time_s;  // one frame at 25 a second
    EXPECT_LT(through("overcast", time_s), 0.01) << time_s;
    EXPECT_EQ(through("clear", time_s), 1.0);
  }
  EXPECT_LT(least, 0.5);
  EXPECT_GT(most, 0.9);
}

TEST(CloudProperty, OvercastDimsTheGroundAsRealOnesDo) {
  const SunPosition sun = sun_at(150.0, 45.0);
  SkyOptions options;
  const double clear = total_lux(*make_sky(options, sun), sun, 3.0);
  options.clouds.preset = "overcast";
  const double overcast = luminance(horizontal_illuminance(*make_sky(options, sun)));
  EXPECT_GT(overcast / clear, 0.1);
  EXPECT_LT(overcast / clear, 0.4);
}

}  // namespace
}  // namespace render
