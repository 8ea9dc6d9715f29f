// `skyshaft detect` on a picture of a tag that the test draws, and what it says of wrong usage.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "ar/track/camera.h"
#include "tests/testing/run_program.h"
#include "tests/testing/tag_pictures.h"

namespace {

using ::testing::HasSubstr;

constexpr double kFovRad = 60.0 * 0.017453292519943295;
constexpr double kSizeM = 0.16;
const cv::Vec3d kPlace(0.05, -0.02, 0.6);  // of the tag, in the camera's frame, metres

// A 640x480 picture of tag 7, turned so that its edges cross the pixels at every phase, through the pinhole that `--fov
// 60` assumes; its true corners.
std::array<cv::Point2d, 4> draw_tag(const std::string& path) {
  const ar::CameraModel camera = ar::camera_from_horizontal_fov(640, 480, kFovRad);
  const ar::testing::TagPicture tag{"tag36h11", 7, kSizeM, ar::testing::facing_tag(kPlace, 0.3, 0.2, 0.25)};
  EXPECT_TRUE(cv::imwrite(path, ar::testing::draw_tags(camera, {tag})));
  return ar::testing::true_corners_px(camera, tag);
}

TEST(Detect, PrintsCornersAsCsv) {
  const cli::Folder folder;
  const auto truth = draw_tag(folder.path("tag.png"));
  const cli::Result result = cli::skyshaft({"detect", folder.path("tag.png"), "-o", folder.path("tags.csv")});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto rows = cli::read_csv(folder.path("tags.csv"));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0][3], "family");
  EXPECT_EQ(rows[1][3], "tag36h11");
  EXPECT_EQ(rows[1][4], "7");
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(std::stod(rows[1][7 + 2 * i]), truth[i].x, 0.2);  // twice the detector's usual error
    EXPECT_NEAR(std::stod(rows[1][8 + 2 * i]), truth[i].y, 0.2);
  }
}

TEST(Detect, PrintsPosesAsJsonWhenCameraAndSizeAreKnown) {
  const cli::Folder folder;
  draw_tag(folder.path("tag.png"));
  const cli::Result result =
      cli::skyshaft({"detect", folder.path("tag.png"), "--fov", "60", "--size", "0.16", "--format", "json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto list = nlohmann::json::parse(result.out);
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0]["id"], 7);
  const auto position = list[0]["camera_from_tag"]["position_m"].get<std::vector<double>>();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(position[i], kPlace[static_cast<int>(i)], 0.003);  // 0.5 % of the distance
  }
}

// Seen exactly from in front, the two poses that a square allows are one.
TEST(Detect, LeavesTheSecondPoseOutWhereThereIsNone) {
  const cli::Folder folder;
  const std::string picture = folder.path("board.png");
  ASSERT_EQ(cli::skyshaft({"board", "aprilgrid:2x2:60mm:0.3", "-o", picture, "--dpi", "72"}).status, 0);
  for (const std::string format : {"csv", "json"}) {
    const cli::Result found = cli::skyshaft(
        {"detect", picture, "--fov", "60", "--size", "0.06", "--format", format, "-o", folder.path("tags." + format)});
    ASSERT_EQ(found.status, 0) << found.err;
  }
  const auto rows = cli::read_csv(folder.path("tags.csv"));
  std::ifstream in(folder.path("tags.json"));
  const auto list = nlohmann::json::parse(in);
  ASSERT_EQ(rows.size(), 5U);
  ASSERT_EQ(list.size(), 4U);
  ASSERT_EQ(rows[0].back(), "second_rms_px");
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].size(), rows[0].size());
    EXPECT_EQ(rows[i].back(), "");
  }
  for (const auto& tag : list) EXPECT_TRUE(tag["camera_from_tag"]["second_rms_px"].is_null()) << tag;
}

TEST(Detect, DecimatesByWhatTheLibraryKnowsAndRefusesTheRest) {
  const cli::Folder folder;
  draw_tag(folder.path("tag.png"));
  for (const char* factor : {"1", "1.5", "2", "3"}) {
    const cli::Result found = cli::skyshaft({"detect", folder.path("tag.png"), "--decimate", factor});
    EXPECT_EQ(found.status, 0) << found.err;
    EXPECT_THAT(found.out, HasSubstr("tag36h11,7,")) << factor;
  }
  for (const char* factor : {"1.2", "1.7", "2.5", "0.5", "17", "nan", "two"}) {
    const cli::Result refused = cli::skyshaft({"detect", folder.path("tag.png"), "--decimate", factor});
    EXPECT_EQ(refused.status, 2) << factor;
    EXPECT_THAT(refused.err, HasSubstr("accepted: 1, 1.5, or a whole number from 2 to 16")) << factor;
    EXPECT_THAT(refused.err, HasSubstr("'" + std::string(factor) + "'"));
  }
}

TEST(Detect, RefusesHalfAPose) {
  const cli::Folder folder;
  draw_tag(folder.path("tag.png"));
  const cli::Result result = cli::skyshaft({"detect", folder.path("tag.png"), "--size", "0.16"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("a pose needs both the camera and the tag's size"));
}

TEST(Detect, KeepsAnExistingFileUnlessToldOtherwise) {
  const cli::Folder folder;
  draw_tag(folder.path("tag.png"));
  const std::string out = folder.write("tags.csv", "mine");
  const cli::Result refused = cli::skyshaft({"detect", folder.path("tag.png"), "-o", out});
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.err, HasSubstr("exists already"));
  EXPECT_EQ(cli::read_csv(out)[0][0], "mine");
  EXPECT_EQ(cli::skyshaft({"detect", folder.path("tag.png"), "-o", out, "--overwrite"}).status, 0);
  EXPECT_EQ(cli::read_csv(out)[0][0], "file");
}

}  // namespace
