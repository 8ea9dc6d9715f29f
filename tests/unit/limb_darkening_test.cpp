#include "render/sun/limb_darkening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/sun/spectrum.h"
#include "render/sun/sun.h"

namespace render {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

// Mean over the disc's area, in rings of equal area.
template <typename Value>
auto mean_over_disc(const Value& value) {
  constexpr int kRings = 20000;
  auto sum = value(std::sqrt(0.5 / kRings));
  for (int i = 1; i < kRings; ++i) sum += value(std::sqrt((i + 0.5) / kRings));
  return sum / static_cast<double>(kRings);
}

double area_share(double height) {
  return 0.5 + (std::asin(height) + height * std::sqrt(1.0 - height * height)) / std::numbers::pi;
}

TEST(LimbDarkening, HasMeanOneOverTheDisc) {
  for (const double nm : {380.0, 450.0, 550.0, 700.0, 780.0}) {
    EXPECT_NEAR(mean_over_disc([nm](double r) { return limb_darkening(r, nm); }), 1.0, 1e-4) << nm;
  }
  const glm::dvec3 rgb = mean_over_disc([](double r) { return limb_darkening_rgb(r); });
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(rgb[c], 1.0, 2e-3) << c;  // the table's steps
}

TEST(LimbDarkening, FallsToTheLimbAndReddensThere) {
  double before = 2.0;
  for (double r = 0.0; r <= 1.0; r += 0.01) {
    const glm::dvec3 rgb = limb_darkening_rgb(r);
    EXPECT_LT(luminance(rgb), before) << r;
    before = luminance(rgb);
    EXPECT_GE(rgb.b, 0.0) << r;
  }
  EXPECT_NEAR(limb_darkening(0.0, 550.0), 1.25, 0.01);  // 1 + 0.51 / 2
  EXPECT_GT(limb_darkening_rgb(0.95).r / limb_darkening_rgb(0.95).b, 1.1);
  EXPECT_EQ(limb_darkening(1.0, 550.0), 0.0);
}

TEST(LimbDarkening, ShareAboveAnEdgeIsTheIntegralOfTheLaw) {
  for (const double height : {-0.8, -0.3, 0.2, 0.6}) {
    const double share = mean_over_disc([height](double r) {
      // Part of the ring at r above the edge, which lies `height` below the middle.
      const double half_angle = std::acos(std::clamp(-height / r, -1.0, 1.0));
      return limb_darkening(r, 550.0) * half_angle / std::numbers::pi;
    });
    EXPECT_NEAR(visible_light_share(height, 550.0), share, 1e-4) << height;
  }
  EXPECT_NEAR(visible_light_share(0.0, 550.0), 0.5, 1e-9);
  EXPECT_EQ(visible_light_share(-1.0, 550.0), 0.0);
  EXPECT_EQ(visible_light_share(1.0, 550.0), 1.0);
  for (double height = -0.95; height < 0.0; height += 0.05) {
    EXPECT_LT(visible_light_share(height, 550.0), area_share(height)) << height;
  }
}

TEST(LimbDarkening, EvenDiscCastsTheSamePenumbra) {
  const double second_moment = mean_over_disc([](double r) { return limb_darkening(r, 555.0) * r * r; });
  EXPECT_NEAR(even_disc_radius() * even_disc_radius() / 2.0, second_moment, 1e-4);
  SunPosition sun;
  sun.elevation_rad = sun.apparent_elevation_rad = 30.0 * kDeg;
  EXPECT_NEAR(sun_light(sun, 3.0).shadow_radius_rad, 0.94 * sun.angular_radius_rad, 0.01 * sun.angular_radius_rad);
}

TEST(LimbDarkening, LastOfTheDiscIsFainterAndRedderThanItsArea) {
  SunPosition sun;
  const auto light = [&sun](double height_radii) {
    sun.elevation_rad = sun.apparent_elevation_rad = height_radii * sun.angular_radius_rad;
    return sun_light(sun, 2.45);
  };
  const SunLight sliver = light(-0.8);
  const SunLight half = light(0.0);
  EXPECT_LT(luminance(sliver.illuminance_rgb) / luminance(half.illuminance_rgb),
            sliver.visible_disc_fraction / half.visible_disc_fraction);
  EXPECT_LT(xyz_from_rgb(sliver.illuminance_rgb).z / luminance(sliver.illuminance_rgb),
            xyz_from_rgb(half.illuminance_rgb).z / luminance(half.illuminance_rgb) + 1e-12);
}

}  // namespace
}  // namespace render
