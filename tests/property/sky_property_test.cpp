// Where sun and sky code is known to break: the whole range of suns, turbidities, conditions and directions.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>
#include <string>

#include "render/sky/clear_sky_irradiance.h"
#include "render/sky/hemisphere.h"
#include "render/sky/moon.h"
#include "render/sky/perez.h"
#include "render/sky/preetham.h"
#include "render/sky/sky_light.h"
#include "render/sky/sky_models.h"
#include "render/sky/twilight.h"
#include "render/sun/air_mass.h"
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

bool is_light(const glm::dvec3& rgb) {
  for (int c = 0; c < 3; ++c) {
    if (!std::isfinite(rgb[c]) || rgb[c] < 0.0) return false;
  }
  return true;
}

// Directions all over the sphere, poles, horizon and the sun with rounding errors of single precision among them.
std::vector<glm::dvec3> views(const SunPosition& sun) {
  std::vector<glm::dvec3> list = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {1, 0, 1e-17}, {1, 0, -1e-9}};
  list.push_back(glm::dvec3(glm::vec3(sun.apparent_direction_in_world())) * 1.0000001);
  list.push_back(-sun.apparent_direction_in_world());
  for (int i = 0; i < 60; ++i) {
    const double z = -1.0 + 2.0 * i / 59.0;
    const double radius = std::sqrt(1.0 - z * z);
    list.push_back({radius * std::sin(2.4 * i), radius * std::cos(2.4 * i), z});
  }
  return list;
}

double total_lux(const SkyModel& sky, const SunPosition& sun, double turbidity) {
  const double direct = luminance(sun_light(sun, turbidity).illuminance_rgb);
  return luminance(horizontal_illuminance(sky)) + direct * std::max(std::sin(sun.apparent_elevation_rad), 0.0);
}

// Of a family of skies the first, the middle and the last.
std::set<std::string> one_word_or_three_of_each_model() {
  std::set<std::string> words;
  for (const SkyModelInfo& model : sky_models()) {
    if (model.words.empty()) continue;
    words.insert({model.words.front(), model.words[model.words.size() / 2], model.words.back()});
  }
  return words;
}

TEST(SkyProperty, EveryModelIsFiniteAndNotNegativeEverywhere) {
  for (const std::string& model : one_word_or_three_of_each_model()) {
    for (const double turbidity : {1.0, 1.64, 3.0, 20.0}) {
      for (const double elevation : {-90.0, -18.0, -6.0, -0.833, -1e-9, 0.0, 0.01, 3.0, 60.0, 90.0}) {
        const SunPosition sun = sun_at(123.0, elevation);
        const auto sky = make_sky({.model = model, .turbidity = turbidity}, sun);
        for (const glm::dvec3& view : views(sun)) {
          ASSERT_TRUE(is_light(sky->luminance_rgb(view))) << model << " turbidity " << turbidity << " sun " << elevation
                                                          << " view " << view.x << ' ' << view.y << ' ' << view.z;
        }
      }
    }
  }
}

TEST(SkyProperty, CloudsAreFiniteAtEveryHour) {
  for (const char* preset : {"clear", "light", "cloudy", "overcast", "night"}) {
    for (const double elevation : {-30.0, -3.0, 0.0, 10.0, 90.0}) {
      const SunPosition sun = sun_at(10.0, elevation);
      SkyOptions options;
      options.clouds = {preset, 43210.0, 7};
      options.moon = MoonPosition{1.0, 0.7, 0.7, 3.8e8, 0.5, 0.9};
      const auto sky = make_sky(options, sun);
      for (const glm::dvec3& view : views(sun)) {
        ASSERT_TRUE(is_light(sky->luminance_rgb(view))) << preset << ' ' << elevation;
        const double through = sky->transmittance(view);
        ASSERT_TRUE(through >= 0.0 && through <= 1.0) << preset << ' ' << elevation << ' ' << through;
      }
    }
  }
}

// edge cases 10 and 11
TEST(SkyProperty, RescaledPreethamStaysRealAtTurbiditiesWhereTheFormulaDoesNot) {
  for (const double turbidity : {1.0, 1.2, 1.3, 1.643, 1.7, 11.3, 15.0, 20.0}) {
    for (const double elevation : {0.3, 2.0, 30.0, 89.9}) {
      const SunPosition sun = sun_at(0.0, elevation);
      const auto sky = make_sky({.model = "preetham:rescaled", .turbidity = turbidity}, sun);
      double brightest = 0.0;
      for (const glm::dvec3& view : views(sun)) brightest = std::max(brightest, luminance(sky->luminance_rgb(view)));
      EXPECT_GT(brightest, 10.0) << turbidity << ' ' << elevation;
      EXPECT_LT(brightest, 2e5) << turbidity << ' ' << elevation;
    }
  }
}

// edge case 12: the bare formula is some 500 times too bright there
TEST(SkyProperty, PublishedPreethamFollowsTheTwilightBelowTheHorizon) {
  for (const double turbidity : {2.0, 4.0, 10.0}) {
    const double at_horizon =
        luminance(horizontal_illuminance(*make_sky({.model = "preetham", .turbidity = turbidity}, sun_at(0.0, 0.0))));
    const double below =
        luminance(horizontal_illuminance(*make_sky({.model = "preetham", .turbidity = turbidity}, sun_at(0.0, -5.0))));
    EXPECT_NEAR(below / at_horizon, clear_illuminance_lux(-5.0 * kDeg) / clear_illuminance_lux(0.0), 1e-3);
  }
}

// edge case 17
TEST(SkyProperty, AirMassIsFiniteAndFallsWithElevation) {
  double before = 1e9;
  for (double elevation = -90.0; elevation <= 90.0; elevation += 0.25) {
    const double mass = relative_air_mass(elevation * kDeg);
    ASSERT_TRUE(mass >= 0.99 && mass <= before) << elevation << ' ' << mass;
    before = mass;
  }
  EXPECT_NEAR(relative_air_mass(0.0), 38.0, 0.2);
}

// edge case 18
TEST(SkyProperty, ClearnessAndBrightnessHoldForNoisyReadings) {
  for (const double zenith : {0.0, 1.0, kPi / 2.0, 2.0, -0.1}) {
    for (const double dni : {-5.0, 0.0, 1e-9, 900.0}) {
      for (const double dhi : {-5.0, 0.0, 1e-9, 100.0}) {
        const double clearness = sky_clearness(dni, dhi, zenith);
        const double brightness = sky_brightness(dhi, zenith, 1367.0);
        ASSERT_TRUE(clearness >= 1.0 && clearness <= 12.0) << dni << ' ' << dhi << ' ' << clearness;
        ASSERT_TRUE(brightness >= 0.01 && brightness <= 0.6) << dni << ' ' << dhi << ' ' << brightness;
      }
    }
  }
}

// edge cases 19 to 21 and 23
TEST(SkyProperty, PerezShapesAreValidForEveryCondition) {
  for (const PerezBins bins : {PerezBins::Original, PerezBins::Interpolated}) {
    for (const double clearness : {1.0, 1.064, 1.066, 1.4, 1.7, 2.5, 3.5, 5.0, 6.3, 12.0}) {
      for (const double brightness : {-1.0, 0.0, 0.01, 0.03, 0.2, 0.45, 0.6, 3.0}) {
        for (const double zenith_deg : {0.0, 1.0, 20.0, 45.0, 75.0, 89.0, 90.0, 120.0}) {
          const PerezShape shape = perez_shape(clearness, brightness, zenith_deg * kDeg, bins);
          const std::string where =
              std::to_string(clearness) + ' ' + std::to_string(brightness) + ' ' + std::to_string(zenith_deg);
          ASSERT_LT(shape.b, 0.0) << where;
          for (const double x : {shape.a, shape.c, shape.d, shape.e}) ASSERT_TRUE(std::isfinite(x)) << where;
        }
      }
    }
  }
  const PerezShape dark = perez_shape(1.7, 0.05, 1.0, PerezBins::Original);
  const PerezShape raised = perez_shape(1.7, 0.2, 1.0, PerezBins::Original);
  EXPECT_EQ(dark.a, raised.a);
  EXPECT_EQ(dark.b, raised.b);
}

// edge case 21: other programs print a black sky here
TEST(SkyProperty, NoConditionGivesABlackSky) {
  for (const double clearness : {2.9, 3.5, 7.0, 12.0}) {
    for (const double brightness : {0.01, 0.03, 0.3, 0.6}) {
      for (const double elevation : {2.0, 25.0, 60.0, 89.0}) {
        SkyOptions options;
        options.bins = PerezBins::Original;
        options.condition = SkyCondition{clearness, brightness};
        const auto sky = make_sky(options, sun_at(0.0, elevation));
        ASSERT_GT(luminance(horizontal_illuminance(*sky)), 10.0) << clearness << ' ' << brightness << ' ' << elevation;
      }
    }
  }
}

// edge case 22; the level too in sky_edge_cases_test.cpp
TEST(SkyProperty, InterpolatedSkyDoesNotJumpAtTheLimitsOfTheBins) {
  const double zenith = 50.0 * kDeg;
  double largest_original = 0.0;
  for (const double limit : {1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2}) {
    for (const double gamma : {0.05, 0.5, 1.2, 2.5}) {
      const auto step = [&](PerezBins bins) {
        const auto value = [&](double clearness) {
          return perez_luminance(perez_shape(clearness, 0.25, zenith, bins), 0.5, gamma, std::cos(gamma));
        };
        return std::abs(std::log(value(limit + 1e-4) / value(limit - 1e-4)));
      };
      EXPECT_LT(step(PerezBins::Interpolated), 0.02) << limit << ' ' << gamma;
      largest_original = std::max(largest_original, step(PerezBins::Original));
    }
  }
  EXPECT_GT(largest_original, 0.2);  // the published bins do jump
}

// edge case 24
TEST(SkyProperty, DiffuseIlluminanceIsWhatTheSkyWasNormalisedTo) {
  SkyOptions options;
  options.irradiance = SkyIrradiance{700.0, 120.0};
  const SunPosition sun = sun_at(30.0, 40.0);
  const double zenith = kPi / 2.0 - sun.elevation_rad;
  const double efficacy =
      diffuse_efficacy(sky_clearness(700.0, 120.0, zenith), sky_brightness(120.0, zenith, kSolarConstantWm2), zenith,
                       PerezBins::Interpolated);
  EXPECT_NEAR(luminance(horizontal_illuminance(*make_sky(options, sun))) / (120.0 * efficacy), 1.0, 1e-9);
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

TEST(SkyProperty, SunAtTheZenithLooksTheSameFromEveryAzimuth) {
  for (const char* model : {"perez", "reference", "preetham"}) {
    const auto here = make_sky({.model = model}, sun_at(0.0, 90.0));
    const auto there = make_sky({.model = model}, sun_at(217.0, 90.0));
    const glm::dvec3 view(0.6, 0.0, 0.8);
    EXPECT_NEAR(luminance(here->luminance_rgb(view)) / luminance(there->luminance_rgb(view)), 1.0, 1e-6) << model;
  }
}

TEST(SkyProperty, AzimuthWrapsWithoutASeam) {
  for (const char* model : {"perez", "reference"}) {
    const auto sky = make_sky({.model = model}, sun_at(0.0, 20.0));
    for (const double behind : {0.0, 180.0, 360.0}) {
      const glm::dvec3 left = sun_at(behind - 0.01, 30.0).direction_in_world();
      const glm::dvec3 right = sun_at(behind + 0.01, 30.0).direction_in_world();
      EXPECT_NEAR(luminance(sky->luminance_rgb(left)) / luminance(sky->luminance_rgb(right)), 1.0, 1e-4) << model;
    }
  }
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
