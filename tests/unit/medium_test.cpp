#include "render/medium/medium.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace render {
namespace {

TEST(Visibility, IsWhereContrastFallsToFivePercent) {
  const double extinction = extinction_from_visibility(1000.0);
  EXPECT_NEAR(std::exp(-extinction * 1000.0), 0.05, 2e-5);  // 2.996 is ln 20 to four digits
  EXPECT_THROW(extinction_from_visibility(0.0), std::invalid_argument);
  EXPECT_THROW(extinction_from_visibility(-1.0), std::invalid_argument);
}

TEST(ScatteredFraction, IsAccurateWhereTheAirIsNearlyClear) {
  EXPECT_DOUBLE_EQ(scattered_fraction(1e-18, 1.0), 1e-18);  // 1 - exp(-x) would give 0
  EXPECT_EQ(scattered_fraction(0.0, std::numeric_limits<double>::infinity()), 0.0);
  EXPECT_EQ(scattered_fraction(1.0, 1e3), 1.0);
  EXPECT_EQ(scattered_fraction(1e-9, std::numeric_limits<double>::infinity()), 1.0);
  EXPECT_EQ(transmittance(0.0, std::numeric_limits<double>::infinity()), 1.0);
}

TEST(Phase, MatchesHandComputedValues) {
  constexpr double kPi = std::numbers::pi;
  EXPECT_NEAR(phase(PhaseFunction::Rayleigh, 0.0, 1.0), 3.0 / (8.0 * kPi), 1e-15);
  EXPECT_NEAR(phase(PhaseFunction::HenyeyGreenstein, 0.5, 1.0), 0.75 / (4.0 * kPi * 0.125), 1e-12);
  EXPECT_NEAR(phase(PhaseFunction::HenyeyGreenstein, 0.5, -1.0), 0.75 / (4.0 * kPi * 3.375), 1e-12);
  EXPECT_NEAR(phase(PhaseFunction::CornetteShanks, 0.0, 0.3), phase(PhaseFunction::Rayleigh, 0.0, 0.3), 1e-15);
}

TEST(Phase, PositiveGIsBrightWhenLookingTowardsTheLight) {
  EXPECT_GT(phase(PhaseFunction::HenyeyGreenstein, 0.7, 1.0), phase(PhaseFunction::HenyeyGreenstein, 0.7, -1.0));
  EXPECT_LT(phase(PhaseFunction::CornetteShanks, -0.7, 1.0), phase(PhaseFunction::CornetteShanks, -0.7, -1.0));
}

TEST(Phase, RefusesGOutsideItsRange) {
  EXPECT_THROW(phase(PhaseFunction::HenyeyGreenstein, 1.0, 0.0), std::invalid_argument);
  EXPECT_THROW(phase(PhaseFunction::HenyeyGreenstein, std::nan(""), 0.0), std::invalid_argument);
}

// Midpoint rule, for comparison: its error falls with the square of the step.
double summed_depth(const Medium& medium, const glm::dvec3& from, const glm::dvec3& along, double length_m) {
  constexpr int kSteps = 100000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += extinction_at(medium, from + along * (length_m * (i + 0.5) / kSteps));
  return sum * length_m / kSteps;
}

TEST(HeightFalloff, OpticalDepthIsTheIntegralOfExtinction) {
  Medium medium{.extinction_per_m = 0.02, .falloff = HeightFalloff{.base_m = 3.0, .scale_height_m = 8.0}};
  EXPECT_DOUBLE_EQ(extinction_at(medium, {5.0, 5.0, 3.0}), 0.02);
  EXPECT_DOUBLE_EQ(extinction_at(medium, {5.0, 5.0, 11.0}), 0.02 / std::numbers::e);
  const glm::dvec3 from(1.0, 2.0, 6.0);
  for (const glm::dvec3& along : {glm::dvec3(0.0, 0.6, 0.8), glm::dvec3(0.0, 0.6, -0.8), glm::dvec3(1.0, 0.0, 0.0),
                                  glm::dvec3(std::sqrt(1.0 - 1e-12), 0.0, 1e-6)}) {
    const double expected = summed_depth(medium, from, along, 30.0);
    EXPECT_NEAR(optical_depth(medium, from, along, 30.0) / expected, 1.0, 1e-8) << "dz " << along.z;
  }
}

TEST(HeightFalloff, EndsAtInfinity) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  const Medium medium{.extinction_per_m = 0.02, .falloff = HeightFalloff{.base_m = 0.0, .scale_height_m = 8.0}};
  EXPECT_DOUBLE_EQ(optical_depth(medium, {}, {0.0, 0.6, 0.8}, kEndless), 0.02 * 8.0 / 0.8);
  EXPECT_EQ(optical_depth(medium, {}, {0.0, 1.0, 0.0}, kEndless), kEndless);
  EXPECT_EQ(optical_depth(medium, {}, {0.0, 0.6, -0.8}, kEndless), kEndless);
  EXPECT_EQ(optical_depth(Medium{}, {}, {0.0, 0.6, -0.8}, kEndless), 0.0);
  // From so high that the extinction there underflows, down to the base: all of the column.
  EXPECT_NEAR(optical_depth(medium, {0.0, 0.0, 1e4}, {0.0, 0.0, -1.0}, 1e4), 0.02 * 8.0, 1e-12);
}

TEST(SunOpticalDepth, CountsFromWhereTheLightEntersTheExtent) {
  Medium medium{.extinction_per_m = 0.1};
  const glm::dvec3 sun(0.6, 0.0, 0.8);
  EXPECT_EQ(sun_optical_depth(medium, {}, sun), 0.0);
  medium.extent = Box{{-3.0, -3.0, 0.0}, {3.0, 3.0, 4.0}};
  EXPECT_DOUBLE_EQ(sun_optical_depth(medium, {0.0, 0.0, 0.0}, sun), 0.5);  // through the top
  EXPECT_DOUBLE_EQ(sun_optical_depth(medium, {2.4, 0.0, 0.0}, sun), 0.1);  // through the side
  EXPECT_DOUBLE_EQ(sun_optical_depth(medium, {0.0, 0.0, 4.0}, sun), 0.0);
  medium.falloff = HeightFalloff{.base_m = 0.0, .scale_height_m = 2.0};
  EXPECT_NEAR(sun_optical_depth(medium, {0.0, 0.0, 0.0}, sun), 0.1 * 2.0 / 0.8 * (1.0 - std::exp(-2.0)), 1e-15);
}

}  // namespace
}  // namespace render
