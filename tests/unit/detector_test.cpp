#include "ar/track/detector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/testing/tag_pictures.h"

namespace ar {
namespace {

using testing::draw_tags;
using testing::facing_tag;
using testing::frame_of;
using testing::TagPicture;
using testing::true_corners_px;

CameraModel small_camera() {
  return camera_from_horizontal_fov(480, 360, 1.0);
}

double worst_corner_px(const Detection& found, const std::array<cv::Point2d, 4>& truth) {
  double worst = 0.0;
  for (std::size_t i = 0; i < 4; ++i) worst = std::max(worst, cv::norm(found.corners_px[i] - truth[i]));
  return worst;
}

// One tag of every family: id, corner order and the size that AprilTag's documentation gives it, the inverted families
// measured at the outer edge of their white border.
TEST(Detector, FindsTheCornersOfEveryFamilyInOpenCvPixels) {
  for (const std::string& family : tag_families()) {
    const TagPicture tag{family, 3, 0.2, facing_tag({0.02, -0.01, 0.8}, 0.3, -0.4, 0.5)};
    DetectorOptions options;
    options.families = {family};
    const auto found = Detector(options).detect(draw_tags(small_camera(), {tag}));
    ASSERT_EQ(found.size(), 1u) << family;
    EXPECT_EQ(found[0].family, family);
    EXPECT_EQ(found[0].id, 3);
    // Half a pixel's error of convention would show as 0.7 px.
    EXPECT_LT(worst_corner_px(found[0], true_corners_px(small_camera(), tag)), 0.2) << family;
  }
}

TEST(Detector, FindsAFramesTagInTenBitsInRgbAndBottomUp) {
  const TagPicture tag{"tag36h11", 7, 0.2, facing_tag({0.0, 0.0, 0.9}, 0.2, 0.3)};
  const cv::Mat picture = draw_tags(small_camera(), {tag});
  Detector detector;
  const Detection plain = detector.detect(frame_of(picture, 0.0)).at(0);

  cv::Mat ten_bits;
  picture.convertTo(ten_bits, CV_16U, 4.0, 3.0);
  Frame frame10 = frame_of(ten_bits, 0.0);
  frame10.format.bit_depth = 10;
  EXPECT_LT(worst_corner_px(detector.detect(frame10).at(0), plain.corners_px), 0.02);

  Frame rgb = frame_of(picture, 0.0);
  rgb.format.color.matrix = ColorMatrix::Rgb;
  rgb.plane.fill(picture.data);
  rgb.stride_bytes.fill(static_cast<std::ptrdiff_t>(picture.step[0]));
  EXPECT_LT(worst_corner_px(detector.detect(rgb).at(0), plain.corners_px), 0.02);

  cv::Mat upward(picture.size(), CV_8U);
  for (int y = 0; y < picture.rows; ++y) picture.row(y).copyTo(upward.row(picture.rows - 1 - y));
  Frame bottom_up = frame_of(upward, 0.0);
  bottom_up.plane[0] = upward.ptr(upward.rows - 1);
  bottom_up.stride_bytes[0] = -static_cast<std::ptrdiff_t>(upward.step[0]);
  EXPECT_LT(worst_corner_px(detector.detect(bottom_up).at(0), plain.corners_px), 1e-9);
}

TEST(Detector, RegionsGiveTheCornersOfTheWholePicture) {
  const TagPicture tag{"tag36h11", 7, 0.2, facing_tag({0.1, 0.05, 0.9}, 0.2, 0.3)};
  const cv::Mat picture = draw_tags(small_camera(), {tag}, 2.0);
  for (double decimate : {1.0, 2.0}) {
    DetectorOptions options;
    options.quad_decimate = decimate;
    Detector detector(options);
    const Detection whole = detector.detect(picture).at(0);
    const auto inside = detector.detect(picture, {{200, 96, 240, 200}, {184, 88, 256, 216}, {-90, -90, 100, 100}});
    ASSERT_EQ(inside.size(), 1u) << "overlapping regions count a tag once";
    EXPECT_LT(worst_corner_px(inside[0], whole.corners_px), 0.02);
  }
}

// The library alone looks for edges beyond the picture there and is off by up to 1.4 px.
TEST(Detector, TagsAtThePicturesEdgeKeepTheirAccuracy) {
  const CameraModel camera = camera_from_horizontal_fov(480, 360, 0.8);
  for (double decimate : {1.0, 2.0, 3.0}) {
    DetectorOptions options;
    options.quad_decimate = decimate;
    Detector detector(options);
    for (double y : {-0.232, -0.228, -0.224, -0.22, -0.21}) {
      const TagPicture tag{"tag36h11", 5, 0.16, facing_tag({0.0, y, 1.2}, 0.4, -0.3, 0.2)};
      const auto truth = true_corners_px(camera, tag);
      const auto found = detector.detect(draw_tags(camera, {tag}, 1.0));
      const bool inside = std::all_of(truth.begin(), truth.end(), [](const cv::Point2d& c) { return c.y >= 0.0; });
      if (inside) {
        ASSERT_EQ(found.size(), 1u) << y;
      }
      // 0.1 px is the noise; a tag that is cut off has less to go by, but nothing worse than a pixel comes out.
      for (const Detection& d : found) EXPECT_LT(worst_corner_px(d, truth), inside ? 0.2 : 1.0) << decimate << ' ' << y;
    }
  }
}

TEST(Detector, PicturesTooSmallForATagAreEmpty) {
  DetectorOptions options;
  options.quad_decimate = 2.0;
  Detector detector(options);
  for (int side : {1, 2, 3, 5, 8, 17, 31, 33}) {
    EXPECT_TRUE(detector.detect(cv::Mat(side, 2 * side, CV_8U, cv::Scalar(90))).empty()) << side;
  }
}

TEST(Detector, BlurDoesNotTouchTheCallersPicture) {
  DetectorOptions options;
  options.quad_sigma = 1.0;
  const TagPicture tag{"tag36h11", 7, 0.2, facing_tag({0.0, 0.0, 0.9}, 0.2, 0.3)};
  const cv::Mat picture = draw_tags(small_camera(), {tag});
  const cv::Mat before = picture.clone();
  EXPECT_EQ(Detector(options).detect(picture).size(), 1u);
  EXPECT_EQ(cv::norm(picture, before, cv::NORM_INF), 0.0);
}

TEST(Detector, AnUnknownFamilyIsNamedAndTheKnownListed) {
  DetectorOptions options;
  options.families = {"tag36h11", "tag37h12"};
  try {
    Detector detector(options);
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(),
                ::testing::AllOf(::testing::HasSubstr("tag37h12"), ::testing::HasSubstr("tagCircle21h7")));
  }
}

}  // namespace
}  // namespace ar
