#include "render/images/image_io.h"

#include <ImfArray.h>
#include <ImfRgbaFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>

#include "render/base/whole_file.h"
#include "tests/testing/gltf_maker.h"

namespace {

using render::Image;
using render::LinearImage;
using testing::AllOf;
using testing::HasSubstr;

LinearImage scene(int width, int height) {
  std::mt19937 random(4);
  LinearImage image{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    const float scale = i % 7 == 0 ? 1.6e9F : 3000.0F;  // the sun's disc beside the sky
    const auto value = [&] { return scale * static_cast<float>(random() % 1000) / 999.0F; };
    image.rgb.emplace_back(value(), value(), value());
  }
  return image;
}

// The reader's message; fails the test when it accepts the bytes.
template <typename Read>
std::string refusal(const test::Bytes& bytes, Read read) {
  const test::TemporaryFolder folder;
  test::write(folder / "broken.file", bytes);
  try {
    read(folder / "broken.file");
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("broken.file"));
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return "";
}

TEST(Exr, ComesBackBitEqual) {
  const test::TemporaryFolder folder;
  const LinearImage image = scene(37, 21);
  render::write_exr(folder / "a.exr", image);
  const LinearImage back = render::read_exr(folder / "a.exr");
  EXPECT_EQ(back.width, 37);
  EXPECT_EQ(back.height, 21);
  EXPECT_EQ(back.rgb, image.rgb);
}

TEST(Exr, HalfRgbaAndLuminanceAreRead) {
  const test::TemporaryFolder folder;
  const std::vector<Imf::Rgba> pixels(4 * 4, Imf::Rgba(0.5F, 2.0F, 1024.0F, 0.25F));
  const std::string color = folder / "color.exr";
  const std::string grey = folder / "grey.exr";
  {
    Imf::RgbaOutputFile file(color.c_str(), 4, 4, Imf::WRITE_RGBA);
    file.setFrameBuffer(pixels.data(), 1, 4);
    file.writePixels(4);
    Imf::RgbaOutputFile luminance(grey.c_str(), 4, 4, Imf::WRITE_Y);
    luminance.setFrameBuffer(pixels.data(), 1, 4);
    luminance.writePixels(4);
  }
  EXPECT_EQ(render::read_exr(color).rgb[5], glm::vec3(0.5F, 2.0F, 1024.0F));
  const glm::vec3 y = render::read_exr(grey).rgb[5];
  EXPECT_NEAR(y.x, 0.2126F * 0.5F + 0.7152F * 2.0F + 0.0722F * 1024.0F, 0.1F);  // half of a number below 128
  EXPECT_EQ(y.x, y.z);
}

TEST(Exr, BrokenFilesAreNamed) {
  const test::TemporaryFolder folder;
  render::write_exr(folder / "a.exr", scene(16, 16));
  test::Bytes bytes = render::read_file(folder / "a.exr");
  bytes.resize(bytes.size() / 2);
  refusal(bytes, render::read_exr);
  refusal(test::bytes_of("no picture"), render::read_exr);
  refusal({}, render::read_exr);
}

TEST(RadianceHdr, KeepsEachPixelWithinItsMantissa) {
  for (const int width : {4, 8, 200}) {  // flat below 8, run-length coded from there
    const test::TemporaryFolder folder;
    const LinearImage image = scene(width, 9);
    render::write_hdr(folder / "a.hdr", image);
    const LinearImage back = render::read_hdr(folder / "a.hdr");
    ASSERT_EQ(back.rgb.size(), image.rgb.size());
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
      const float largest = std::max({image.rgb[i].x, image.rgb[i].y, image.rgb[i].z});
      // Half a step of an 8-bit mantissa that is at least 128.
      EXPECT_LE(glm::distance(back.rgb[i], image.rgb[i]), 1.7321F * largest / 256.0F * 1.0001F) << "pixel " << i;
    }
  }
}

TEST(RadianceHdr, LongRunsComeBackAndAreSmall) {
  const test::TemporaryFolder folder;
  LinearImage image{1000, 2, std::vector<glm::vec3>(2000, glm::vec3(1.0F, 0.5F, 0.25F))};
  image.rgb[700] = glm::vec3(0.0F);
  render::write_hdr(folder / "a.hdr", image);
  EXPECT_EQ(render::read_hdr(folder / "a.hdr").rgb, image.rgb);
  EXPECT_LT(std::filesystem::file_size(folder / "a.hdr"), 300U);
}

TEST(RadianceHdr, ExposureIsTakenOutAndRowsAreTurned) {
  const test::TemporaryFolder folder;
  test::Bytes bytes = test::bytes_of("#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n+Y 2 +X 1\n");
  for (const int byte : {128, 0, 0, 129, 0, 128, 0, 129}) bytes.push_back(static_cast<std::uint8_t>(byte));
  test::write(folder / "a.hdr", bytes);
  const LinearImage image = render::read_hdr(folder / "a.hdr");
  EXPECT_EQ(image.rgb[0], glm::vec3(0.0F, 0.5F, 0.0F));
  EXPECT_EQ(image.rgb[1], glm::vec3(0.5F, 0.0F, 0.0F));
}

TEST(RadianceHdr, BrokenFilesAreNamed) {
  EXPECT_THAT(refusal(test::bytes_of("P6 1 1 255\n"), render::read_hdr), HasSubstr("#?RADIANCE"));
  EXPECT_THAT(refusal(test::bytes_of("#?RADIANCE\n\n-Y 0 +X 4\n"), render::read_hdr), HasSubstr("-Y 0 +X 4"));
  EXPECT_THAT(refusal(test::bytes_of("#?RADIANCE\n\n-Y 4 +X 4\nabc"), render::read_hdr), HasSubstr("truncated"));
  EXPECT_THAT(refusal(test::bytes_of("#?RADIANCE\n\n-Y 1 +X 8\n\x02\x02\x00\x09"), render::read_hdr),
              HasSubstr("truncated"));
}

TEST(Png, ComesBackEqualWithAndWithoutAlpha) {
  const test::TemporaryFolder folder;
  Image image{3, 2, {}};
  for (std::uint8_t i = 0; i < 24; ++i) image.rgba.push_back(i % 4 == 3 ? std::uint8_t{255} : i);
  render::write_png(folder / "a.png", image);
  EXPECT_EQ(render::read_png(folder / "a.png").rgba, image.rgba);
  image.rgba[7] = 10;
  render::write_png(folder / "a.png", image);
  EXPECT_EQ(render::read_png(folder / "a.png").rgba, image.rgba);
}

TEST(Png, BrokenFilesAndWrongSizesAreNamed) {
  refusal(test::bytes_of("no picture"), render::read_png);
  const test::TemporaryFolder folder;
  EXPECT_THROW(render::write_png(folder / "a.png", Image{3, 2, {1, 2, 3}}), std::runtime_error);
  EXPECT_THROW(render::write_exr(folder / "a.exr", LinearImage{3, 2, {}}), std::runtime_error);
  EXPECT_THROW(render::write_hdr(folder / "a.hdr", LinearImage{}), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "a refused picture leaves nothing behind";
}

TEST(WholeFile, FailureLeavesTheOldFileAndNothingElse) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "target");
  const test::Bytes bytes = {1, 2, 3};
  try {
    render::write_file_whole(folder / "target", bytes);  // a folder cannot be replaced by a file
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("target"));
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  EXPECT_THROW(render::write_file_whole(folder / "no/such/folder/file", bytes), std::runtime_error);
}

}  // namespace
