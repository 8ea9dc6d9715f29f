// The three sun tiers against published positions, and the sun's day.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "render/sun/sun.h"
#include "render/sun/sun_events.h"

namespace {

using namespace std::chrono;
using render::Place;
using render::SunTier;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

Place degrees(double latitude, double longitude, double height_m = 0.0) {
  return {latitude * kRadPerDeg, longitude * kRadPerDeg, height_m};
}

glm::dvec3 direction(double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * kRadPerDeg;
  const double elevation = elevation_deg * kRadPerDeg;
  return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation), std::sin(elevation)};
}

double separation_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return 2.0 * std::asin(std::min(1.0, glm::length(a - b) / 2.0)) / kRadPerDeg;
}

struct Published {
  render::UtcTime time;
  Place place;
  double azimuth_deg;
  double elevation_deg;
};

// The worked example of Reda & Andreas 2004 (NREL/TP-560-34302): topocentric azimuth 194.34024, zenith angle 50.11162
// with 0.01632 of refraction; Golden, Colorado. Its UT1-UTC and delta T differ from ours by 0.0015 degrees at most.
const Published kSpaExample{sys_days{2003y / October / 17} + hours(19) + minutes(30) + seconds(30),
                            degrees(39.742476, -105.1786, 1830.14), 194.34024, 90.0 - 50.11162 - 0.01632};

TEST(SunTiers, MatchThePublishedSpaExampleWithinTheirStatedErrors) {
  const glm::dvec3 published = direction(kSpaExample.azimuth_deg, kSpaExample.elevation_deg);
  const auto error = [&](SunTier tier) {
    return separation_deg(render::sun_position(kSpaExample.place, kSpaExample.time, tier).direction_in_world(),
                          published);
  };
  EXPECT_LT(error(SunTier::Precise), 0.002);
  EXPECT_LT(error(SunTier::Psa), 0.012 + 0.002);
  EXPECT_LT(error(SunTier::Daily), 1.4);
}

// Seeded by construction: a lattice of times and places that shares no period with days or years.
TEST(SunTiers, StayWithinTheirStatedErrorsFrom1950To2100) {
  double worst_psa = 0.0;
  double worst_daily = 0.0;
  const render::UtcTime first = sys_days{1950y / January / 1};
  const auto span = sys_days{2101y / January / 1} - sys_days{1950y / January / 1};
  constexpr int kSamples = 4000;
  for (int i = 0; i < kSamples; ++i) {
    const render::UtcTime time = first + duration_cast<microseconds>(span) / kSamples * i + seconds(i * 37);
    const Place place = degrees(std::fmod(i * 61.803, 180.0) - 90.0, std::fmod(i * 137.508, 360.0) - 180.0);
    const glm::dvec3 precise = render::sun_position(place, time, SunTier::Precise).direction_in_world();
    worst_psa = std::max(worst_psa,
                         separation_deg(precise, render::sun_position(place, time, SunTier::Psa).direction_in_world()));
    worst_daily = std::max(
        worst_daily, separation_deg(precise, render::sun_position(place, time, SunTier::Daily).direction_in_world()));
  }
  EXPECT_LT(worst_psa, 0.012);
  EXPECT_LT(worst_daily, 1.4);
  EXPECT_GT(worst_daily, 0.5) << "the day-of-year formula cannot be that good: is it the one asked for?";
}

TEST(SunTiers, LeapYearsAndThe2100RuleKeepTheDayOfYear) {
  for (const sys_days day :
       {sys_days{2024y / February / 29}, sys_days{2024y / December / 31}, sys_days{2100y / February / 28},
        sys_days{2100y / March / 1}, sys_days{2100y / March / 2}}) {
    const Place place = degrees(10.0, 179.9999);
    const render::UtcTime noon = day + hours(12);
    EXPECT_LT(separation_deg(render::sun_position(place, noon, SunTier::Daily).direction_in_world(),
                             render::sun_position(place, noon, SunTier::Precise).direction_in_world()),
              1.4)
        << year_month_day{day}.month().operator unsigned();
  }
}

TEST(SunTiers, AreFiniteAtThePolesTheDateLineAndTheZenith) {
  for (const SunTier tier : {SunTier::Daily, SunTier::Psa, SunTier::Precise}) {
    for (const double latitude : {-90.0, -89.9, 0.0, 23.44, 89.9, 90.0}) {
      for (const double longitude : {-180.0, 0.0, 179.999999, 180.0}) {
        const auto sun =
            render::sun_position(degrees(latitude, longitude), sys_days{2024y / June / 20} + hours(12), tier);
        EXPECT_TRUE(std::isfinite(sun.azimuth_rad) && std::isfinite(sun.elevation_rad)) << latitude << ' ' << longitude;
        EXPECT_GE(sun.azimuth_rad, 0.0);
        EXPECT_LT(sun.azimuth_rad, 2.0 * std::numbers::pi);
        EXPECT_NEAR(glm::length(sun.direction_in_world()), 1.0, 1e-12);
      }
    }
  }
}

TEST(SunTiers, TheDateLineIsNoEdge) {
  const render::UtcTime time = sys_days{2024y / March / 20} + hours(23);
  for (const SunTier tier : {SunTier::Daily, SunTier::Psa, SunTier::Precise}) {
    EXPECT_LT(separation_deg(render::sun_position(degrees(30.0, 180.0), time, tier).direction_in_world(),
                             render::sun_position(degrees(30.0, -180.0), time, tier).direction_in_world()),
              1e-9);
  }
}

// US Naval Observatory: Greenwich, 21 June 2024: rise 03:43, transit 12:02, set 20:21 UT, to the minute.
TEST(SunEvents, MatchTheAlmanacAtGreenwich) {
  const auto day = sys_days{2024y / June / 21};
  const auto events = render::sun_events(degrees(51.4779, 0.0), day + hours(12));
  ASSERT_TRUE(events.rise && events.set);
  EXPECT_NEAR(duration<double>(*events.rise - (day + hours(3) + minutes(43))).count(), 0.0, 60.0);
  EXPECT_NEAR(duration<double>(events.transit - (day + hours(12) + minutes(2))).count(), 0.0, 60.0);
  EXPECT_NEAR(duration<double>(*events.set - (day + hours(20) + minutes(21))).count(), 0.0, 60.0);
}

TEST(SunEvents, PolarDayAndNightHaveNoRiseAndNoSet) {
  const Place tromso = degrees(69.65, 18.96);
  const auto summer = render::sun_events(tromso, sys_days{2024y / June / 21} + hours(11));
  EXPECT_FALSE(summer.rise || summer.set);
  EXPECT_TRUE(summer.always_up);
  const auto winter = render::sun_events(tromso, sys_days{2024y / December / 21} + hours(11));
  EXPECT_FALSE(winter.rise || winter.set);
  EXPECT_FALSE(winter.always_up);
  EXPECT_LT(winter.transit_elevation_rad, 0.0);
}

TEST(SunEvents, CrossingsLieOnTheThreshold) {
  const Place place = degrees(48.86, 2.29);
  const double civil = -6.0 * kRadPerDeg;
  const auto events = render::sun_events(place, sys_days{2025y / April / 3} + hours(12), civil);
  ASSERT_TRUE(events.rise && events.set);
  EXPECT_NEAR(render::sun_position(place, *events.rise).elevation_rad, civil, 1e-5);
  EXPECT_NEAR(render::sun_position(place, *events.set).elevation_rad, civil, 1e-5);
  EXPECT_LT(*events.rise, events.transit);
  EXPECT_GT(*events.set, events.transit);
}

// Its extremes are in every almanac: about -14 min 15 s near 11 February and +16 min 25 s near 3 November.
TEST(EquationOfTime, HasTheAlmanacsExtremes) {
  EXPECT_NEAR(render::equation_of_time_s(sys_days{2024y / February / 11} + hours(12)), -(14 * 60 + 14), 5.0);
  EXPECT_NEAR(render::equation_of_time_s(sys_days{2024y / November / 3} + hours(12)), 16 * 60 + 26, 5.0);
}

}  // namespace
