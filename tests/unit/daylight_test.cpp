// Place, time and options to sun, moon, sky and the light that casts shadows.

#include "render/daylight/daylight.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/sun/spectrum.h"

namespace render {
namespace {

using namespace std::chrono_literals;
using std::chrono::sys_days;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

const Place kProvence{43.5263 * kRadPerDeg, 5.4454 * kRadPerDeg, 180.0};

UtcTime at(int year, unsigned month, unsigned day, std::chrono::minutes minute) {
  return sys_days{std::chrono::year{year} / static_cast<int>(month) / static_cast<int>(day)} + minute;
}

TEST(Daylight, PlaceAndTimeGiveSunMoonHeightAndTheCloudsHour) {
  const UtcTime time = at(2024, 9, 14, 15h + 20min);
  const Daylight light = daylight({.place = kProvence, .time = time});
  const SunPosition sun = sun_position(kProvence, time);
  EXPECT_EQ(light.sun.azimuth_rad, sun.azimuth_rad);
  EXPECT_EQ(light.direct.direction_in_world, sun.apparent_direction_in_world());
  EXPECT_EQ(light.direct.illuminance_rgb, sun_light(sun, kClearTurbidity, 180.0).illuminance_rgb);
  EXPECT_EQ(light.sun_illuminance_rgb, light.direct.illuminance_rgb);
  EXPECT_EQ(light.sky_options.height_m, 180.0);
  EXPECT_EQ(light.sky_options.clouds.time_s, 15.0 * 3600.0 + 20.0 * 60.0);
  ASSERT_TRUE(light.sky_options.moon);
  EXPECT_EQ(light.sky_options.moon->azimuth_rad, moon_position(kProvence, time).azimuth_rad);
  EXPECT_FALSE(light.direct.is_moon);
}

TEST(Daylight, CloudsHourIsThatOfTheDayBefore1970Too) {
  EXPECT_EQ(daylight({.place = kProvence, .time = at(1969, 7, 20, 6h)}).sky_options.clouds.time_s, 6.0 * 3600.0);
}

TEST(Daylight, AGivenSunStandsWhereItIsToldAndWithoutAPlaceThereIsNoMoon) {
  const Daylight light = daylight({.time = at(2024, 1, 1, 12h),
                                   .sun = {.azimuth_rad = 2.0, .elevation_rad = 0.5, .angular_radius_rad = 0.01},
                                   .sky = {.height_m = 1200.0}});
  EXPECT_EQ(light.sun.azimuth_rad, 2.0);
  EXPECT_EQ(light.sun.apparent_elevation_rad, 0.5);
  EXPECT_NEAR(light.direct.direction_in_world.z, std::sin(0.5), 1e-12);
  EXPECT_EQ(light.direct.angular_radius_rad, 0.01);
  EXPECT_EQ(light.sky_options.height_m, 1200.0);
  EXPECT_EQ(light.sky_options.clouds.time_s, 12.0 * 3600.0);
  EXPECT_FALSE(light.sky_options.moon);
}

TEST(Daylight, AGivenIlluminanceOrColorChangesTheOtherNot) {
  const DaylightRequest natural{.sun = {.azimuth_rad = 2.0, .elevation_rad = 0.5}};
  const double natural_lux = luminance(daylight(natural).direct.illuminance_rgb);
  DaylightRequest dim = natural;
  dim.sun.illuminance_lux = 1000.0;
  EXPECT_NEAR(luminance(daylight(dim).direct.illuminance_rgb), 1000.0, 0.1);
  EXPECT_NEAR(daylight(dim).direct.illuminance_rgb.r, daylight(dim).direct.illuminance_rgb.b, 1e-9);
  DaylightRequest red = natural;
  red.sun.color_rgb = glm::dvec3(2.0, 1.0, 0.5);
  const glm::dvec3 rgb = daylight(red).direct.illuminance_rgb;
  EXPECT_NEAR(luminance(rgb) / natural_lux, 1.0, 1e-3);  // the weights of level and of luminance() differ in digit five
  EXPECT_NEAR(rgb.r / rgb.b, 4.0, 1e-9);
}

TEST(Daylight, TheMoonCastsTheShadowsOnceTheSunIsDown) {
  DaylightRequest request{.place = kProvence, .time = at(2024, 6, 21, 22h + 30min)};  // the night before full moon
  const Daylight night = daylight(request);
  EXPECT_TRUE(night.direct.is_moon);
  EXPECT_EQ(night.sun_illuminance_rgb, glm::dvec3(0.0));
  EXPECT_EQ(night.direct.direction_in_world, night.sky_options.moon->apparent_direction_in_world());
  EXPECT_GT(luminance(night.direct.illuminance_rgb), 0.02);
  request.sun.illuminance_lux = 0.0;  // who gives the sun's light means that and no other
  EXPECT_FALSE(daylight(request).direct.is_moon);
}

TEST(Daylight, CloudsDimWhatComesThroughThem) {
  DaylightRequest request{.place = kProvence, .time = at(2024, 9, 14, 12h)};
  const double clear = luminance(daylight(request).direct.illuminance_rgb);
  request.sky.clouds.preset = "overcast";
  const Daylight grey = daylight(request);
  const double through = grey.sky->transmittance(grey.direct.direction_in_world);
  EXPECT_LT(through, 0.2);
  EXPECT_NEAR(luminance(grey.direct.illuminance_rgb), clear * through, 1e-9 * clear);
  EXPECT_EQ(grey.sun_illuminance_rgb, grey.direct.illuminance_rgb);
}

TEST(Daylight, MeasuredIrradianceSetsTheSunsLevel) {
  DaylightRequest request{.place = kProvence, .time = at(2024, 9, 14, 12h)};
  request.sky.irradiance = SkyIrradiance{400.0, 200.0};
  const Daylight hazy = daylight(request);
  EXPECT_NEAR(luminance(hazy.direct.illuminance_rgb), *given_sun_lux(hazy.sky_options, hazy.sun), 1e-6);
}

TEST(Daylight, GroundReturnsDirectLightAndSky) {
  const DaylightRequest request{.place = kProvence, .time = at(2024, 9, 14, 12h)};
  const Daylight light = daylight(request);
  const SkyLight sky = sky_light(light, 0.3);
  const glm::dvec3 on_ground =
      sky.horizontal_illuminance_rgb + light.direct.illuminance_rgb * light.direct.direction_in_world.z;
  EXPECT_NEAR(sky.ground_luminance_rgb.g / (0.3 * on_ground.g / std::numbers::pi), 1.0, 1e-6);
}

TEST(Daylight, SkyNoneIsBlackAndOtherSkiesThatCannotBeMadeAreRefused) {
  const GivenSun sun{.azimuth_rad = 2.0, .elevation_rad = 0.5};
  const Daylight light = daylight({.sun = sun, .sky = {.model = "none"}});
  ASSERT_NE(light.sky, nullptr);
  EXPECT_EQ(light.sky->luminance_rgb({0.0, 0.0, 1.0}), glm::dvec3(0.0));
  EXPECT_THROW(daylight({.sun = sun, .sky = {.model = "green"}}), std::runtime_error);
}

}  // namespace
}  // namespace render
