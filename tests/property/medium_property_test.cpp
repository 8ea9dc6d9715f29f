#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/medium/medium.h"

namespace render {
namespace {

constexpr double kGs[] = {-0.99, -0.9, -0.5, -1e-9, 0.0, 0.2, 0.7, 0.95, 0.99};
constexpr PhaseFunction kFunctions[] = {PhaseFunction::HenyeyGreenstein, PhaseFunction::CornetteShanks,
                                        PhaseFunction::Rayleigh};

// 2 pi integral of p(mu) P_band(mu), with nodes crowded at both ends, where g = +-0.99 peaks: mu = sin(pi/2 sin s).
double moment(PhaseFunction function, double g, int band) {
  constexpr int kSteps = 20000;
  constexpr double kHalfPi = std::numbers::pi / 2.0;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double s = -kHalfPi + std::numbers::pi * (i + 0.5) / kSteps;
    const double angle = kHalfPi * std::sin(s);
    const double mu = std::sin(angle);
    const double slope = std::cos(angle) * kHalfPi * std::cos(s);
    const double legendre = band == 0 ? 1.0 : band == 1 ? mu : 1.5 * mu * mu - 0.5;
    sum += phase(function, g, mu) * legendre * slope;
  }
  return 2.0 * std::numbers::pi * sum * std::numbers::pi / kSteps;
}

TEST(PhaseProperty, EveryFunctionIntegratesToOneAndHasItsClosedMoments) {
  for (const PhaseFunction function : kFunctions) {
    for (const double g : kGs) {
      const glm::dvec3 closed = phase_moments(function, g);
      for (int band = 0; band < 3; ++band) {
        // 1e-6: error of the quadrature at the peak of g = 0.99
        EXPECT_NEAR(moment(function, g, band), closed[band], 1e-6) << "g " << g << " band " << band;
      }
      EXPECT_EQ(closed[0], 1.0);
    }
  }
}

TEST(PhaseProperty, IsFiniteAndPositiveForEveryAngleEvenBeyondRoundingError) {
  for (const PhaseFunction function : kFunctions) {
    for (const double g : kGs) {
      for (double mu = -1.0 - 1e-7; mu <= 1.0 + 2e-7; mu += 1e-3) {
        const double p = phase(function, g, mu);
        ASSERT_TRUE(std::isfinite(p) && p > 0.0) << "g " << g << " cos " << mu << " p " << p;
      }
    }
  }
}

TEST(ScatteredFractionProperty, RisesFromZeroToOneAndComplementsTransmittance) {
  double before = 0.0;
  for (double optical_depth = 1e-12; optical_depth <= 1e3; optical_depth *= 1.5) {
    const double fraction = scattered_fraction(optical_depth / 50.0, 50.0);
    ASSERT_GE(fraction, before);
    ASSERT_LE(fraction, 1.0);
    ASSERT_NEAR(fraction + transmittance(optical_depth / 50.0, 50.0), 1.0, 1e-15) << optical_depth;
    before = fraction;
  }
}

TEST(ScatteredFractionProperty, TendsToTheOpticalDepthWhereTheAirIsClear) {
  for (double optical_depth = 1e-300; optical_depth < 1e-9; optical_depth *= 10.0) {
    ASSERT_NEAR(scattered_fraction(optical_depth, 1.0) / optical_depth, 1.0, 1e-9);
  }
}

}  // namespace
}  // namespace render
