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

}  // namespace
}  // namespace render
