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

}  // namespace
}  // namespace render
