// The places where sun code breaks, numbered in the order that published programs were seen to break there. 5 and 6
// stand in sun_table_test.cpp, where times are read.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "render/sun/refraction.h"
#include "render/sun/sun.h"
#include "render/sun/sun_events.h"

namespace {

using namespace std::chrono;
using render::Place;
using render::SunTier;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr SunTier kTiers[] = {SunTier::Daily, SunTier::Psa, SunTier::Precise};

Place degrees(double latitude, double longitude) {
  return {latitude * kRadPerDeg, longitude * kRadPerDeg, 0.0};
}

double separation_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / kRadPerDeg;
}

glm::dvec3 sun(const Place& place, render::UtcTime time, SunTier tier) {
  return render::sun_position(place, time, tier).direction_in_world();
}

TEST(EdgeCase01, PolesAreNoEdges) {
  for (const SunTier tier : kTiers) {
    for (const double sign : {-1.0, 1.0}) {
      for (int month = 1; month <= 12; ++month) {
        const render::UtcTime time = sys_days{2024y / std::chrono::month(static_cast<unsigned>(month)) / 21} + 5h;
        const glm::dvec3 at_pole = sun(degrees(sign * 90.0, 40.0), time, tier);
        ASSERT_TRUE(std::isfinite(at_pole.x + at_pole.y + at_pole.z));
        EXPECT_LT(separation_deg(at_pole, sun(degrees(sign * (90.0 - 1e-7), 40.0), time, tier)), 1e-6);
        // a tenth of a degree away the sun stands at most a tenth of a degree elsewhere
        EXPECT_LT(separation_deg(at_pole, sun(degrees(sign * 89.9, 40.0), time, tier)), 0.1001);
      }
    }
  }
}

TEST(EdgeCase02, SunInTheZenithAndInTheNadirHasADirection) {
  for (const SunTier tier : kTiers) {
    for (const bool nadir : {false, true}) {
      Place place = degrees(10.0, 20.0);
      const render::UtcTime time = sys_days{2024y / April / 15} + 11h;
      // Walk towards the place that the sun stands above, or below: its direction's horizontal part points there.
      for (int i = 0; i < 40; ++i) {
        const glm::dvec3 direction = nadir ? -sun(place, time, tier) : sun(place, time, tier);
        place.latitude_rad = std::clamp(place.latitude_rad + 0.5 * std::atan2(direction.y, direction.z),
                                        -std::numbers::pi / 2.0, std::numbers::pi / 2.0);
        place.longitude_rad += 0.5 * std::atan2(direction.x, direction.z);
      }
      const render::SunPosition position = render::sun_position(place, time, tier);
      EXPECT_NEAR(std::abs(position.elevation_rad) / kRadPerDeg, 90.0, 0.01) << nadir;
      EXPECT_TRUE(position.azimuth_rad >= 0.0 && position.azimuth_rad < 2.0 * std::numbers::pi);
      EXPECT_NEAR(position.direction_in_world().z, nadir ? -1.0 : 1.0, 1e-7);
    }
  }
}

TEST(EdgeCase03, DateLineHasOneDayOfTheYear) {
  for (const SunTier tier : kTiers) {
    for (const int hour : {0, 11, 13, 23}) {
      const render::UtcTime time = sys_days{2024y / March / 20} + hours(hour);  // declination changes fastest
      const glm::dvec3 west = sun(degrees(30.0, -180.0), time, tier);
      EXPECT_LT(separation_deg(west, sun(degrees(30.0, 180.0), time, tier)), 1e-9);
      EXPECT_LT(separation_deg(west, sun(degrees(30.0, 179.999999), time, tier)), 1e-5);
    }
  }
}

// The day of the year decides the day-of-year formula: a day too many shows as 0.4 degrees near the equinoxes.
TEST(EdgeCase04, LeapDaysCountAnd2100HasNone) {
  const Place place = degrees(48.0, 11.0);
  const auto noon = [&](sys_days day) { return sun(place, day + 12h, SunTier::Daily); };
  EXPECT_LT(separation_deg(noon(2100y / March / 1), noon(2023y / March / 1)), 1e-9);
  EXPECT_LT(separation_deg(noon(2100y / December / 31), noon(2023y / December / 31)), 1e-9);
  EXPECT_GT(separation_deg(noon(2100y / March / 1), noon(2024y / March / 1)), 0.3);  // one is day 60, the other 61
  EXPECT_LT(separation_deg(noon(2024y / February / 29), noon(2023y / March / 1)), 1e-9);
  const double last_day = separation_deg(noon(2024y / December / 30), noon(2024y / December / 31));
  EXPECT_GT(last_day, 0.02);
  EXPECT_LT(last_day, 0.2);
}

TEST(EdgeCase07, PolarDayAndNightHaveNoRise) {
  for (const double latitude : {69.0, 80.0, 89.99, 90.0, -75.0, -90.0}) {
    for (const sys_days day : {sys_days{2024y / June / 21}, sys_days{2024y / December / 21}}) {
      const auto events = render::sun_events(degrees(latitude, 15.0), day + 12h);
      EXPECT_FALSE(events.rise || events.set) << latitude;
      const bool summer = (day == sys_days{2024y / June / 21}) == (latitude > 0.0);
      EXPECT_EQ(events.always_up, summer) << latitude;
      EXPECT_TRUE(std::isfinite(events.transit_elevation_rad));
    }
  }
}

TEST(EdgeCase08, RefractionOutsideItsFormulaStaysALift) {
  for (const render::Weather weather : {render::Weather{1010.0, 10.0}, render::Weather{1080.0, -60.0}}) {
    const double thickest = weather.pressure_hpa / 1010.0 * 283.0 / (273.0 + weather.temperature_c);
    double before = -100.0;
    for (double elevation = -90.0; elevation <= 90.0; elevation += 0.01) {
      const double apparent = render::apparent_elevation(elevation * kRadPerDeg, weather) / kRadPerDeg;
      ASSERT_GT(apparent, before) << elevation;
      ASSERT_GE(apparent, elevation - 1e-12);
      ASSERT_LE(apparent - elevation, thickest * 44.6 / 60.0) << elevation;  // the formula's own largest lift
      if (elevation < -3.5) {
        ASSERT_NEAR(apparent, elevation, 1e-12);
      }
      before = apparent;
    }
    EXPECT_LE(before, 90.0 + 1e-9);
  }
}

TEST(EdgeCase09, DirectLightFadesWithTheDiscNotByAStep) {
  const auto light_at = [](double elevation_deg) {
    render::SunPosition position;
    position.elevation_rad = elevation_deg * kRadPerDeg;
    position.apparent_elevation_rad = render::apparent_elevation(position.elevation_rad, {});
    return render::sun_light(position, 2.45);
  };
  EXPECT_NEAR(light_at(-0.57).visible_disc_fraction, 0.5, 0.05);
  EXPECT_EQ(light_at(-0.9).visible_disc_fraction, 0.0);  // set: the almanacs' -0.833 and a little weather
  EXPECT_GT(light_at(-0.7).visible_disc_fraction, 0.0);
  EXPECT_EQ(light_at(0.0).visible_disc_fraction, 1.0);
  const double full = light_at(0.0).illuminance_rgb.r;
  for (double elevation = -1.0; elevation < 0.0; elevation += 0.005) {
    const double step = light_at(elevation + 0.005).illuminance_rgb.r - light_at(elevation).illuminance_rgb.r;
    EXPECT_GE(step, 0.0) << elevation;
    EXPECT_LT(step, 0.03 * full) << elevation;  // 0.53 degrees of disc in steps of 0.005: 1 % each, 2 in its middle
  }
}

}  // namespace
