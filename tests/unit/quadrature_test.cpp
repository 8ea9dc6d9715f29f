#include "render/shafts/reference/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace render {
namespace {

TEST(Quadrature, ReportsAnErrorThatBoundsItsOwn) {
  const Quadrature sine = integrate([](double x) { return std::sin(x); }, 0.0, std::numbers::pi);
  EXPECT_NEAR(sine.value, 2.0, 1e-14);
  const Quadrature root = integrate([](double x) { return std::sqrt(x); }, 0.0, 1.0, 1e-6);
  EXPECT_LE(std::abs(root.value - 2.0 / 3.0), root.error);
  EXPECT_LT(root.error, 2e-6);
}

TEST(Quadrature, EndsAndSaysHowGoodItIsWhereNothingConverges) {
  int calls = 0;
  const Quadrature noise = integrate([&](double) { return ++calls % 2 == 0 ? 1.0 : 0.0; }, 0.0, 1.0, 1e-12);
  EXPECT_LT(calls, 100000);
  EXPECT_GT(noise.error, 0.0);
  const Quadrature cliff = integrate([](double x) { return std::exp(-1e6 * x); }, 0.0, 1.0, 1e-10);
  EXPECT_NEAR(cliff.value, 1e-6, 1e-15);
}

}  // namespace
}  // namespace render
