#include "render/sky/sky_cube.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/sun/spectrum.h"

namespace render {
namespace {

constexpr double kPi = std::numbers::pi;

class UniformSky final : public SkyModel {
 public:
  glm::dvec3 luminance_rgb(const glm::dvec3&) const override { return {100.0, 200.0, 300.0}; }
};

SunPosition low_sun() {
  SunPosition sun;
  sun.azimuth_rad = 2.0;
  sun.elevation_rad = sun.apparent_elevation_rad = 0.4;
  return sun;
}

template <typename Visit>
void for_each_texel(const CubeLevel& level, const Visit& visit) {
  for (int face = 0; face < 6; ++face) {
    for (int row = 0; row < level.size_px; ++row) {
      for (int column = 0; column < level.size_px; ++column) {
        visit(cube_direction(face, column + 0.5, row + 0.5, level.size_px), cube_texel_sr(column, row, level.size_px),
              glm::dvec3(
                  level.face[static_cast<std::size_t>(face)][static_cast<std::size_t>(row * level.size_px + column)]));
      }
    }
  }
}

glm::dvec3 mean_of(const CubeLevel& level) {
  glm::dvec3 sum(0.0);
  for_each_texel(level, [&](const glm::dvec3&, double sr, const glm::dvec3& rgb) { sum += rgb * sr; });
  return sum / (4.0 * kPi);
}

TEST(SkyCube, TexelsTileTheSphereAndFacesLookWhereGlWantsThem) {
  double solid_angle = 0.0;
  glm::dvec3 moment(0.0);
  CubeLevel level{16, 0.0, {}};
  for (CubeFace& face : level.face) face.assign(256, glm::vec3(1.0F));
  for_each_texel(level, [&](const glm::dvec3& direction, double sr, const glm::dvec3&) {
    solid_angle += sr;
    moment += direction * sr;
  });
  EXPECT_NEAR(solid_angle, 4.0 * kPi, 1e-9);
  EXPECT_NEAR(glm::length(moment), 0.0, 1e-9);
  const glm::dvec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int face = 0; face < 6; ++face) {
    EXPECT_NEAR(glm::length(cube_direction(face, 8.0, 8.0, 16) - axes[face]), 0.0, 1e-12) << face;
  }
  EXPECT_LT(cube_direction(0, 15.5, 8.0, 16).z, 0.0);  // +x: s grows towards -z, t towards -y
  EXPECT_LT(cube_direction(0, 8.0, 15.5, 16).y, 0.0);
  EXPECT_GT(cube_direction(2, 8.0, 15.5, 16).z, 0.0);  // +y: t grows towards +z
}

TEST(SkyCube, EvenSkyStaysEven) {
  for (const CubeLevel& level : make_sky_cube(UniformSky(), {100.0, 200.0, 300.0})) {
    for_each_texel(level, [&](const glm::dvec3&, double, const glm::dvec3& rgb) {
      ASSERT_NEAR(rgb.r, 100.0, 1e-3);
      ASSERT_NEAR(rgb.b, 300.0, 3e-3);
    });
  }
}

TEST(SkyCube, LevelsHalveRoughenAndKeepTheLight) {
  const auto sky = make_sky({}, low_sun());
  const std::vector<CubeLevel> levels = make_sky_cube(*sky, glm::dvec3(800.0), {32, 4});
  ASSERT_EQ(levels.size(), 4u);
  const glm::dvec3 mean = mean_of(levels.front());
  double contrast_before = 1e9;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    EXPECT_EQ(levels[i].size_px, 32 >> i);
    EXPECT_DOUBLE_EQ(levels[i].roughness, static_cast<double>(i) / 3.0);
    EXPECT_NEAR(luminance(mean_of(levels[i])) / luminance(mean), 1.0, 1e-5) << i;
    double contrast = 0.0;
    for_each_texel(levels[i], [&](const glm::dvec3&, double, const glm::dvec3& rgb) {
      contrast = std::max(contrast, luminance(rgb) / luminance(mean));
    });
    EXPECT_LT(contrast, contrast_before) << i;
    contrast_before = contrast;
  }
}

// The rougher levels against the same mean over the sky itself, half a degree apart.
TEST(SkyCube, LevelsAreTheGgxMeanOfTheSky) {
  const auto sky = make_sky({}, low_sun());
  const glm::dvec3 ground(800.0);
  const std::vector<CubeLevel> levels = make_sky_cube(*sky, ground, {32, 4});
  const glm::dvec3 mirrored = low_sun().direction_in_world();
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const double alpha2 = std::pow(levels[i].roughness, 4.0);
    // The texel nearest to the sun's direction.
    glm::dvec3 direction(0.0);
    glm::dvec3 found(0.0);
    for_each_texel(levels[i], [&](const glm::dvec3& d, double, const glm::dvec3& rgb) {
      if (glm::dot(d, mirrored) <= glm::dot(direction, mirrored)) return;
      direction = d;
      found = rgb;
    });
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    for (double elevation = -89.75; elevation < 90.0; elevation += 0.5) {
      for (double azimuth = 0.25; azimuth < 360.0; azimuth += 0.5) {
        const double e = elevation * kPi / 180.0;
        const double a = azimuth * kPi / 180.0;
        const glm::dvec3 view(std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e));
        const double cosine = glm::dot(view, direction);
        if (cosine <= 0.0) continue;
        const double spread = 0.5 * (1.0 + cosine) * (alpha2 - 1.0) + 1.0;
        const double weight = cosine / (spread * spread) * std::cos(e);
        if (weight < 1e-6) continue;
        sum += weight * (view.z < 0.0 ? ground : sky->luminance_rgb(view));
        weights += weight;
      }
    }
    EXPECT_NEAR(luminance(found) / luminance(sum / weights), 1.0, 0.03) << levels[i].roughness;
  }
}

TEST(SkyCube, RefusesSizesThatDoNotFit) {
  EXPECT_THROW(make_sky_cube(UniformSky(), glm::dvec3(0.0), {48, 3}), std::invalid_argument);
  EXPECT_THROW(make_sky_cube(UniformSky(), glm::dvec3(0.0), {16, 4}), std::invalid_argument);
  EXPECT_THROW(make_sky_cube(UniformSky(), glm::dvec3(0.0), {16, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace render
