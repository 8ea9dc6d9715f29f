// Pictures with infinite values and with values that are no numbers.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <limits>
#include <sstream>

#include "render/images/finite_pixels.h"
#include "render/images/image_io.h"
#include "tests/testing/gltf_maker.h"

namespace {

using render::LinearImage;
using testing::HasSubstr;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// What the program logs while this lives.
class Log {
 public:
  Log() : before_(spdlog::default_logger()) {
    spdlog::set_default_logger(
        std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_st>(text_)));
  }
  ~Log() { spdlog::set_default_logger(before_); }
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::shared_ptr<spdlog::logger> before_;
};

LinearImage constant(int width, int height, float value) {
  return {width, height, std::vector<glm::vec3>(static_cast<std::size_t>(width * height), glm::vec3(value))};
}

TEST(InvalidValues, InfinityIsTheLargestHalfOrThePicturesLargestValue) {
  for (const float largest : {2.0F, 1e6F}) {
    LinearImage image = constant(4, 3, 1.0F);
    image.rgb[0].y = largest;
    image.rgb[5] = {kInf, 3.0F, 3e38F};
    EXPECT_EQ(render::replace_invalid_values(image, "sky"), 1U);
    const float peak = std::max(largest, 65504.0F);
    EXPECT_EQ(image.rgb[5], glm::vec3(peak, 3.0F, peak));
    EXPECT_EQ(image.rgb[0], glm::vec3(1.0F, largest, 1.0F));
  }
}

TEST(InvalidValues, WhatIsNoNumberIsTheMeanOfWhatIsAroundIt) {
  LinearImage image = constant(4, 3, 2.0F);
  image.rgb[5] = {kNan, -kInf, 7.0F};
  image.rgb[6] = {kNan, 5.0F, 2.0F};  // beside it: neither is filled from the other
  image.rgb[0].x = 9.0F;
  EXPECT_EQ(render::replace_invalid_values(image, "sky"), 2U);
  EXPECT_EQ(image.rgb[5], glm::vec3(3.0F, 2.375F, 7.0F));
  EXPECT_EQ(image.rgb[6], glm::vec3(2.0F, 5.0F, 2.0F));
}

TEST(InvalidValues, WithoutValidNeighboursTheyAreZero) {
  LinearImage image = constant(5, 5, kNan);
  image.rgb[0] = glm::vec3(4.0F);
  EXPECT_EQ(render::replace_invalid_values(image, "sky"), 24U);
  EXPECT_EQ(image.rgb[1], glm::vec3(4.0F));
  EXPECT_EQ(image.rgb[24], glm::vec3(0.0F));
}

TEST(InvalidValues, APictureOfThemAloneIsRefused) {
  LinearImage image = constant(2, 2, kInf);
  EXPECT_THROW(render::replace_invalid_values(image, "sky"), std::runtime_error);
}

TEST(InvalidValues, ValidPicturesAreKeptAndNothingIsLogged) {
  const Log log;
  LinearImage image = constant(2, 2, -0.25F);
  image.rgb[3] = {1.6e9F, 0.0F, 1e-38F};
  const std::vector<glm::vec3> before = image.rgb;
  EXPECT_EQ(render::replace_invalid_values(image, "sky"), 0U);
  EXPECT_EQ(image.rgb, before);
  EXPECT_EQ(log.text(), "");
}

TEST(InvalidValues, ReadersTellTheFileAndTheirNumber) {
  const test::TemporaryFolder folder;
  LinearImage image = constant(6, 4, 1.0F);
  image.rgb[3].x = kInf;
  image.rgb[9] = glm::vec3(kNan);
  render::write_exr(folder / "sky.exr", image);
  const Log log;
  const LinearImage read = render::read_exr(folder / "sky.exr");
  EXPECT_EQ(read.rgb[3], glm::vec3(65504.0F, 1.0F, 1.0F));
  EXPECT_GT(read.rgb[9].x, 1.0F);  // the overflowed pixel is beside it
  EXPECT_EQ(read.rgb[9].y, 1.0F);
  EXPECT_THAT(log.text(), HasSubstr((folder / "sky.exr").string()));
  EXPECT_THAT(log.text(), HasSubstr("2 of 24 pixels are infinite, too large or not a number"));
}

TEST(InvalidValues, ARadiancePictureOverflowsByItsExposure) {
  const test::TemporaryFolder folder;
  test::Bytes bytes = test::bytes_of("#?RADIANCE\nEXPOSURE=1e-30\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n");
  for (const int byte : {128, 64, 0, 255, 128, 128, 128, 100}) bytes.push_back(static_cast<std::uint8_t>(byte));
  test::write(folder / "a.hdr", bytes);
  const LinearImage image = render::read_hdr(folder / "a.hdr");
  EXPECT_GT(image.rgb[1].x, 1e20F);
  EXPECT_EQ(image.rgb[0], glm::vec3(image.rgb[1].x, image.rgb[1].x, 0.0F));
}

}  // namespace
