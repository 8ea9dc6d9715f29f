#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/sky/hemisphere.h"
#include "render/sky/patches.h"
#include "render/sky/spherical_triangle.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDeg = kPi / 180.0;

SunPosition sun_at(double elevation_deg) {
  SunPosition sun;
  sun.azimuth_rad = 2.0;
  sun.elevation_rad = sun.apparent_elevation_rad = elevation_deg * kDeg;
  return sun;
}

class UniformSky final : public SkyModel {
 public:
  glm::dvec3 luminance_rgb(const glm::dvec3&) const override { return glm::dvec3(1000.0); }
};

PatchOptions patches(const std::string& tessellation, double max_error = 0.005) {
  PatchOptions options;
  options.tessellation = tessellation;
  options.max_error = max_error;
  return options;
}

// A fine sum over directions: half a degree near the zenith, a tenth at the horizon.
double closed_illuminance(const SkyModel& sky) {
  constexpr int kRows = 400;
  constexpr int kSectors = 720;
  double sum = 0.0;
  for (int row = 0; row < kRows; ++row) {
    const double sine2 = (row + 0.5) / kRows;  // equal steps of projected solid angle
    const double z = std::sqrt(1.0 - sine2);
    for (int sector = 0; sector < kSectors; ++sector) {
      const double azimuth = 2.0 * kPi * (sector + 0.5) / kSectors;
      sum +=
          luminance(sky.luminance_rgb({std::sqrt(sine2) * std::sin(azimuth), std::sqrt(sine2) * std::cos(azimuth), z}));
    }
  }
  return sum * kPi / (kRows * kSectors);
}

TEST(SphericalTriangle, OctantHasItsSolidAngleAndMoment) {
  const SphericalTriangle octant{{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}};
  EXPECT_NEAR(octant.solid_angle_sr(), kPi / 2.0, 1e-12);
  EXPECT_NEAR(octant.moment_sr().z, kPi / 4.0, 1e-12);
}

TEST(SkyPatches, EveryTessellationTilesTheHalfSphere) {
  const UniformSky sky;
  for (const char* name : {"dome5728", "dome144", "geodesic"}) {
    const SkyPatches tiles = make_patches(sky, patches(name));
    double solid_angle = 0.0;
    glm::dvec3 moment(0.0);
    for (const SkyPatch& patch : tiles.patches()) {
      solid_angle += patch.solid_angle_sr;
      moment += patch.moment_sr;
      EXPECT_NEAR(glm::length(patch.direction_in_world), 1.0, 1e-12);
    }
    EXPECT_NEAR(solid_angle, 2.0 * kPi, 1e-9) << name;
    EXPECT_NEAR(glm::length(moment - glm::dvec3(0, 0, kPi)), 0.0, 1e-9) << name;
    EXPECT_NEAR(tiles.illuminance_rgb({0, 0, 1}).x, 1000.0 * kPi, 1e-6) << name;
  }
  EXPECT_EQ(make_patches(sky, patches("dome5728")).patches().size(), 5728u);
  EXPECT_EQ(make_patches(sky, patches("dome144")).patches().size(), 144u);
}

TEST(SkyPatches, AgreeOnTheDiffuseHorizontalIlluminance) {
  for (const double elevation_deg : {5.0, 20.0, 45.0, 70.0, 90.0}) {
    for (const char* model : {"perez", "reference", "cie:1"}) {
      const auto sky = make_sky({.model = model}, sun_at(elevation_deg));
      const double truth = closed_illuminance(*sky);
      const auto error = [&](const SkyPatches& tiles) {
        return std::abs(luminance(tiles.illuminance_rgb({0, 0, 1})) / truth - 1.0);
      };
      const std::string where = std::string(model) + " sun " + std::to_string(elevation_deg);
      const SkyPatches adaptive = make_patches(*sky, patches("geodesic"));
      EXPECT_LT(error(make_patches(*sky, patches("dome5728"))), 0.005) << where;
      EXPECT_LT(error(make_patches(*sky, patches("dome144"))), 0.03) << where;
      EXPECT_LT(error(adaptive), 0.005) << where;
      EXPECT_LE(adaptive.patches().size(), 5728u / 5) << where;
    }
  }
}

TEST(SkyPatches, GeodesicKeepsTheErrorThatItStates) {
  const auto sky = make_sky({.model = "perez"}, sun_at(35.0));
  const double truth = closed_illuminance(*sky);
  std::size_t before = 0;
  for (const double stated : {0.05, 0.01, 0.002, 0.0005}) {
    const SkyPatches tiles = make_patches(*sky, patches("geodesic", stated));
    EXPECT_LT(std::abs(luminance(tiles.illuminance_rgb({0, 0, 1})) / truth - 1.0), stated) << stated;
    EXPECT_GE(tiles.patches().size(), before);
    before = tiles.patches().size();
  }
}

// A slit 1 degree wide from horizon to horizon through the zenith, in closed form along and across it.
TEST(SkyPatches, GeodesicKeepsTheErrorThatItStatesThroughASlit) {
  const auto sky = make_sky({.model = "perez"}, sun_at(35.0));
  constexpr int kAlong = 4000;
  constexpr int kAcross = 10;
  double truth = 0.0;
  for (int i = 0; i < kAlong; ++i) {
    const double along = kPi * (i + 0.5) / kAlong;
    for (int j = 0; j < kAcross; ++j) {
      const double across = kDeg * ((j + 0.5) / kAcross - 0.5);
      const glm::dvec3 view(std::sin(across), std::cos(across) * std::cos(along), std::cos(across) * std::sin(along));
      truth += luminance(sky->luminance_rgb(view)) * std::cos(across) * view.z * kPi / kAlong * kDeg / kAcross;
    }
  }
  for (const double stated : {0.05, 0.02, 0.005}) {
    PatchOptions options = patches("geodesic", stated);
    options.visibility = {
        [](const glm::dvec3& d) { return std::abs(d.x) < std::sin(0.5 * kDeg) ? 1.0 : 0.0; },
        [](const glm::dvec3& d) { return std::abs(std::asin(std::min(std::abs(d.x), 1.0)) - 0.5 * kDeg); }};
    const SkyPatches tiles = make_patches(*sky, options);
    EXPECT_LT(std::abs(luminance(tiles.illuminance_rgb({0, 0, 1})) / truth - 1.0), stated) << stated;
  }
}

TEST(SkyPatches, PortalLetsThroughWhatItsSolidAngleHolds) {
  const UniformSky sky;
  // A window of 1 m x 1 m overhead at a height of 2 m: projected solid angle by Lambert's formula.
  const Portal window{{-0.5, -0.5, 2.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  PatchOptions options = patches("geodesic", 0.002);
  options.visibility = through_portals({window}, glm::dvec3(0.0));
  const double half = 0.5 / 2.0;
  const double projected = 4.0 * half / std::sqrt(1.0 + half * half) * std::atan(half / std::sqrt(1.0 + half * half));
  const SkyPatches tiles = make_patches(sky, options);
  EXPECT_NEAR(tiles.illuminance_rgb({0, 0, 1}).x / (1000.0 * projected), 1.0, 0.01);
  EXPECT_NEAR(tiles.radiance_sh()[0].x / (1000.0 * projected * 0.282095), 1.0, 0.08);  // near the zenith cos is 1
}

TEST(SkyPatches, HarmonicsAgreeWithSkyLight) {
  const auto sky = make_sky({.model = "perez"}, sun_at(40.0));
  const Sh9 from_patches = make_patches(*sky, patches("geodesic", 0.002)).radiance_sh();
  const Sh9 direct = sky_light(*sky, glm::dvec3(0.0), 0.0).radiance_sh;
  for (std::size_t i = 0; i < direct.size(); ++i) {
    EXPECT_NEAR(from_patches[i].y, direct[i].y, 0.01 * direct[0].y) << i;
  }
}

TEST(SkyPatches, NameAnUnknownTessellation) {
  EXPECT_THROW(make_patches(UniformSky(), patches("dome145")), std::runtime_error);
}

}  // namespace
}  // namespace render
