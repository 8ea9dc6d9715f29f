// The places where sky code breaks, numbered in the order that published programs were seen to break there; those not
// here are in sky_property_test.cpp (10 to 12, 17 to 19, 21, 23 to 25, 27 to 29) and sky_models_test.cpp (15, 24).

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "render/sky/cie.h"
#include "render/sky/direction.h"
#include "render/sky/hemisphere.h"
#include "render/sky/perez.h"
#include "render/sky/preetham.h"
#include "render/sky/sky_model.h"
#include "render/sky/twilight.h"
#include "render/sun/refraction.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDeg = kPi / 180.0;

SunPosition sun_at(double elevation_deg) {
  SunPosition sun;
  sun.azimuth_rad = 1.0;
  sun.elevation_rad = elevation_deg * kDeg;
  sun.apparent_elevation_rad = apparent_elevation(sun.elevation_rad, {});
  return sun;
}

TEST(EdgeCase13, HorizonAndBelowNeitherDivideNorOverflow) {
  for (const double turbidity : {1.7, 2.0, 6.0, 10.0}) {
    const PreethamShapes shapes = preetham_shapes(turbidity);
    for (const PerezShape& shape : {shapes.luminance, shapes.x, shapes.y}) {
      const double horizon = perez_luminance(shape, 1e-3, 1.0, std::cos(1.0));
      for (const double cosine : {0.0, 1e-17, -1e-9, -0.5, -1.0}) {
        EXPECT_EQ(perez_luminance(shape, cosine, 1.0, std::cos(1.0)), horizon) << turbidity << ' ' << cosine;
      }
    }
  }
  for (int type = 1; type <= 15; ++type) {
    EXPECT_EQ(cie_luminance(cie_shape(type), -0.3, 2.0, std::cos(2.0)),
              cie_luminance(cie_shape(type), 0.0, 2.0, std::cos(2.0)));
  }
}

TEST(EdgeCase14, AngleToTheSunSurvivesRounding) {
  const glm::dvec3 sun(glm::normalize(glm::vec3(0.3F, -0.5F, 0.7F)));
  for (const double length : {1.0 - 1e-7, 1.0, 1.0 + 1e-7, 1.0 + 1e-4}) {
    const Angle angle = angle_between(sun * length, sun);
    EXPECT_TRUE(angle.radians >= 0.0 && angle.radians < 0.001) << length;
    EXPECT_NEAR(angle_between(sun * length, -sun).radians, kPi, 0.001) << length;
  }
}

TEST(EdgeCase16, ColourNeverDividesByItsYAndKeepsItsHueWhenClipped) {
  for (const double y : {0.0, -0.1, 1e-12, 0.33}) {
    const glm::dvec3 xyz = xyz_from_yxy(1000.0, 0.3, y);
    EXPECT_TRUE(std::isfinite(xyz.x + xyz.y + xyz.z)) << y;
    EXPECT_EQ(xyz.y, 1000.0);
  }
  const glm::dvec3 twilight(-0.2, 0.5, 3.0);
  const glm::dvec3 clipped = clip_to_gamut(twilight);
  const glm::dvec3 grey(luminance(twilight));
  EXPECT_NEAR(glm::length(glm::cross(clipped - grey, twilight - grey)), 0.0, 1e-12);  // same hue
  EXPECT_GT(glm::dot(clipped - grey, twilight - grey), 0.0);
  EXPECT_GE(clipped.r, 0.0);
}

TEST(EdgeCase20, OvercastHasNoBrightAureole) {
  for (const double zenith_deg : {0.0, 30.0, 60.0, 85.0}) {
    for (const double brightness : {0.05, 0.1, 0.2}) {
      const PerezShape shape = perez_shape(1.0, brightness, zenith_deg * kDeg, PerezBins::Original);
      const double towards = perez_luminance(shape, 0.5, 0.0, 1.0);
      const double across = perez_luminance(shape, 0.5, kPi / 2.0, 0.0);
      EXPECT_TRUE(std::isfinite(towards) && towards > 0.0);
      EXPECT_LT(towards / across, 2.5) << zenith_deg << ' ' << brightness;  // the linear formula gives 4 and more
    }
  }
}

// The level as well as the shape: the efficacy has bins too.
TEST(EdgeCase22, AnimatedSkyDoesNotJumpAtTheLimitsOfTheBins) {
  for (const double turbidity : {1.5, 2.45, 3.5, 8.0}) {
    std::vector<double> levels;
    for (double elevation = 4.0; elevation < 70.0; elevation += 0.2) {
      const auto sky = make_sky({.model = "preetham:rescaled", .turbidity = turbidity}, sun_at(elevation));
      levels.push_back(std::log(luminance(horizontal_illuminance(*sky))));
    }
    for (std::size_t i = 2; i < levels.size();
         ++i) {  // each step is explained by the one before; a bend gives 0.006, a bin's edge 0.02
      ASSERT_LT(std::abs(levels[i] - 2.0 * levels[i - 1] + levels[i - 2]), 0.01)
          << turbidity << " at " << 4.0 + 0.2 * static_cast<double>(i);
    }
  }
}

TEST(EdgeCase22, MeasuredSkyDoesNotJumpAtTheLimitsOfTheBins) {
  const SunPosition sun = sun_at(40.0);
  const auto level = [&sun](double clearness) {
    SkyOptions options;
    options.condition = SkyCondition{clearness, 0.25};
    return std::log(luminance(horizontal_illuminance(*make_sky(options, sun))));
  };
  for (const double limit : {1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2}) {
    EXPECT_LT(std::abs(level(limit + 1e-4) - level(limit - 1e-4)), 1e-3) << limit;
  }
}

TEST(EdgeCase26, EightDecadesOfLightFitSinglePrecision) {
  const auto total = [](double elevation_deg) {
    const SunPosition sun = sun_at(elevation_deg);
    const double direct = luminance(sun_light(sun, kClearTurbidity).illuminance_rgb);
    return luminance(horizontal_illuminance(*make_sky({}, sun))) +
           direct * std::max(std::sin(sun.apparent_elevation_rad), 0.0);
  };
  EXPECT_GT(total(90.0), 1e5);
  EXPECT_LT(total(-18.0), 2.5e-3);
  for (const double elevation : {90.0, 0.0, -6.0, -12.0, -18.0, -60.0}) {
    const glm::dvec3 view = make_sky({}, sun_at(elevation))->luminance_rgb({0.0, 0.6, 0.8});
    for (int c = 0; c < 3; ++c) EXPECT_GT(view[c], std::numeric_limits<float>::min()) << elevation;
  }
}

TEST(SkyRange, GivenConditionsAtAndBeyondTheirLimitsGiveASky) {
  for (const double clearness : {-1.0, 0.0, 1.0, 12.0, 100.0}) {
    for (const double brightness : {-1.0, 0.0, 0.01, 0.6, 5.0}) {
      for (const double elevation : {0.0, 45.0, 90.0}) {
        SkyOptions options;
        options.condition = SkyCondition{clearness, brightness};
        const double lux = luminance(horizontal_illuminance(*make_sky(options, sun_at(elevation))));
        ASSERT_TRUE(std::isfinite(lux) && lux > 0.0) << clearness << ' ' << brightness << ' ' << elevation;
        const double sun_lux = *given_sun_lux(options, sun_at(elevation));
        ASSERT_TRUE(std::isfinite(sun_lux) && sun_lux >= 0.0) << clearness << ' ' << brightness;
      }
    }
  }
}

TEST(SkyRange, WhatLiesOutsideIsSaid) {
  EXPECT_TRUE(beyond_range({}, sun_at(30.0)).empty());
  EXPECT_EQ(beyond_range({.model = "preetham", .turbidity = 12.0}, sun_at(30.0)).size(), 1u);
  EXPECT_EQ(beyond_range({.model = "perez", .turbidity = 30.0}, sun_at(30.0)).size(), 1u);
  SkyOptions options;
  options.condition = SkyCondition{7.0, 0.5};  // edge case 21: bin 8 has b > 0 there
  EXPECT_EQ(beyond_range(options, sun_at(5.0)).size(), 1u);
  options.condition = SkyCondition{3.0, 0.2};
  EXPECT_TRUE(beyond_range(options, sun_at(30.0)).empty());
}

TEST(SkyRange, GivenIrradiancesSayWhatTheSunGives) {
  SkyOptions options;
  EXPECT_FALSE(given_sun_lux(options, sun_at(40.0)).has_value());
  options.irradiance = SkyIrradiance{800.0, 90.0};
  const double lux = *given_sun_lux(options, sun_at(40.0));
  EXPECT_NEAR(lux / 800.0, 103.0, 6.0);  // lm/W of direct light in a clear sky
  options.condition = SkyCondition{sky_clearness(800.0, 90.0, 50.0 * kDeg), sky_brightness(90.0, 50.0 * kDeg, 1367.0)};
  EXPECT_NEAR(*given_sun_lux(options, sun_at(40.0)) / lux, 1.0, 1e-3);
}

}  // namespace
}  // namespace render
