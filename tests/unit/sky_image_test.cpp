// Pictures of the sky with what pictures should not have.

#include "render/sky/sky_image.h"

#include <ImfRgbaFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "render/base/angles.h"
#include "render/sky/hemisphere.h"
#include "render/sun/spectrum.h"
#include "tests/testing/gltf_maker.h"

namespace {

using render::LinearImage;
using testing::HasSubstr;

constexpr int kWidth = 512;
constexpr int kHeight = 256;

// A blue gradient over grey ground, with a disc of 0.6 degrees in the north, 40 degrees high.
void write_sky(const std::string& path, const Imf::Rgba& disc) {
  const glm::dvec3 sun(0.0, std::cos(40.0 * render::kRadPerDeg), std::sin(40.0 * render::kRadPerDeg));
  std::vector<Imf::Rgba> pixels;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const glm::dvec3 direction = render::lat_long_direction(column, row, kWidth, kHeight);
      const auto level = static_cast<float>(1.6 - direction.z);
      const bool up = direction.z > 0.0;
      pixels.push_back(up ? Imf::Rgba(0.35F * level, 0.55F * level, level) : Imf::Rgba(0.15F, 0.14F, 0.12F));
      if (glm::dot(direction, sun) > std::cos(0.6 * render::kRadPerDeg)) pixels.back() = disc;
    }
  }
  Imf::RgbaOutputFile file(path.c_str(), kWidth, kHeight, Imf::WRITE_RGB);
  file.setFrameBuffer(pixels.data(), 1, kWidth);
  file.writePixels(kHeight);
}

double sky_lux(const std::string& path) {
  return render::luminance(render::horizontal_illuminance(*render::make_image_sky(path, {}, 1e4)));
}

TEST(SkyImageFile, AnOverflowedDiscGivesTheLevelOfTheLargestHalf) {
  const test::TemporaryFolder folder;
  const float inf = std::numeric_limits<float>::infinity();
  write_sky(folder / "largest.exr", Imf::Rgba(65504.0F, 65504.0F, 65504.0F));
  write_sky(folder / "inf.exr", Imf::Rgba(inf, inf, inf));
  write_sky(folder / "below.exr", Imf::Rgba(60000.0F, 57000.0F, 51000.0F));
  EXPECT_DOUBLE_EQ(sky_lux(folder / "inf.exr"), sky_lux(folder / "largest.exr"));
  const double below = sky_lux(folder / "below.exr");
  EXPECT_NEAR(sky_lux(folder / "inf.exr"), below, 0.15 * below) << "a disc 14 % brighter";
}

TEST(SkyImageFile, NanPixelsGiveTheSkyAroundThem) {
  const test::TemporaryFolder folder;
  LinearImage picture{64, 32, std::vector<glm::vec3>(64 * 32, glm::vec3(1.0F))};
  render::write_exr(folder / "whole.exr", picture);
  for (std::size_t i = 100; i < 110; ++i) picture.rgb[i] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
  render::write_exr(folder / "holes.exr", picture);
  EXPECT_NEAR(sky_lux(folder / "holes.exr"), sky_lux(folder / "whole.exr"), 1e-6);
  EXPECT_NEAR(sky_lux(folder / "whole.exr"), 1e4, 1.0);
}

TEST(SkyImageFile, NegativeAndBlackPicturesAreBlackSkies) {
  const test::TemporaryFolder folder;
  LinearImage picture{64, 32, std::vector<glm::vec3>(64 * 32, glm::vec3(-1.0F))};
  render::write_exr(folder / "negative.exr", picture);
  EXPECT_EQ(sky_lux(folder / "negative.exr"), 0.0);
  picture.rgb.assign(picture.rgb.size(), glm::vec3(0.0F));
  picture.rgb[64 * 28] = glm::vec3(1000.0F);  // below the horizon, where no light falls from
  render::write_exr(folder / "below.exr", picture);
  EXPECT_EQ(sky_lux(folder / "below.exr"), 0.0);
}

TEST(SkyImageFile, FilesThatAreNoSkyAreNamed) {
  const test::TemporaryFolder folder;
  render::write_exr(folder / "square.EXR", {4, 4, std::vector<glm::vec3>(16, glm::vec3(1.0F))});
  try {
    render::make_image_sky(folder / "square.EXR", {}, 1e4);
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("square.EXR: a sky picture must be lat-long"));
  }
}

}  // namespace
