// Which of a camera's modes serves a wish, on lists as real cameras give them.

#include "ar/capture/live/camera_mode.h"

#include <gtest/gtest.h>

namespace ar {
namespace {

using Modes = std::vector<CameraMode>;

// A USB 2 webcam: raw pictures are slow where they are large.
const Modes kWebcam{
    {"YUYV", 640, 480, {30, 20, 15}}, {"YUYV", 1280, 720, {10, 5}},      {"YUYV", 1920, 1080, {5}},
    {"MJPG", 640, 480, {60, 30, 15}}, {"MJPG", 1280, 720, {60, 30, 15}}, {"MJPG", 1920, 1080, {30, 15}},
};

LiveRequest request(std::optional<int> width, std::optional<int> height, std::optional<double> rate = {},
                    std::optional<std::string> format = {}) {
  return {width, height, rate, std::move(format)};
}

void expect_choice(const Modes& modes, const LiveRequest& wish, const std::string& format, int width, int height,
                   double rate) {
  const auto choice = choose_mode(modes, wish);
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->mode.format, format) << describe(choice->mode);
  EXPECT_EQ(choice->mode.width, width) << describe(choice->mode);
  EXPECT_EQ(choice->mode.height, height) << describe(choice->mode);
  EXPECT_DOUBLE_EQ(choice->rate, rate);
}

TEST(CameraMode, PicksMjpegWhereRawCannotReachTheRate) {
  expect_choice(kWebcam, {}, "MJPG", 1280, 720, 30);
  expect_choice(kWebcam, request(1920, 1080, 30), "MJPG", 1920, 1080, 30);
}

TEST(CameraMode, PrefersRawWhereItReachesTheRate) {
  expect_choice(kWebcam, request(640, 480), "YUYV", 640, 480, 30);
  expect_choice(kWebcam, request(1920, 1080, 5), "YUYV", 1920, 1080, 5);
  expect_choice(kWebcam, request({}, {}, 10), "YUYV", 1280, 720, 10);
}

TEST(CameraMode, PutsTheSizeThatWasAskedForBeforeTheRate) {
  const Modes modes{{"YUYV", 640, 480, {30}}, {"YUYV", 1920, 1080, {5}}};
  expect_choice(modes, request(1920, 1080, 30), "YUYV", 1920, 1080, 5);
  expect_choice(modes, {}, "YUYV", 640, 480, 30);
}

TEST(CameraMode, TakesTheNearestSizeWhereTheOneAskedForIsNotOffered) {
  expect_choice(kWebcam, request(800, 600, 15), "YUYV", 640, 480, 15);
  expect_choice(kWebcam, request({}, 1080, 30), "MJPG", 1920, 1080, 30);
}

TEST(CameraMode, TakesTheSlowestRateThatReachesTheRequest) {
  const Modes modes{{"YUYV", 640, 480, {120, 60, 29.97, 15}}};
  expect_choice(modes, request({}, {}, 30), "YUYV", 640, 480, 29.97);
  expect_choice(modes, request({}, {}, 50), "YUYV", 640, 480, 60);
  expect_choice(modes, request({}, {}, 200), "YUYV", 640, 480, 120);
}

TEST(CameraMode, TakesAnyRateOfARange) {
  const Modes modes{{"NV12", 1280, 720, {60, 1}, true}};
  expect_choice(modes, request({}, {}, 24), "NV12", 1280, 720, 24);
  expect_choice(modes, request({}, {}, 100), "NV12", 1280, 720, 60);
}

TEST(CameraMode, BelievesInTheRateWhereTheCameraSaysNone) {
  expect_choice({{"YUYV", 1280, 720, {}}}, request({}, {}, 25), "YUYV", 1280, 720, 25);
}

TEST(CameraMode, LosesColourOnlyWhereNothingElseReachesIt) {
  const Modes modes{{"GREY", 1280, 720, {30}}, {"MJPG", 1280, 720, {30}}, {"RGB3", 1280, 720, {30}}};
  expect_choice(modes, {}, "RGB3", 1280, 720, 30);
  expect_choice({modes[0], modes[1]}, {}, "MJPG", 1280, 720, 30);
  expect_choice(modes, request({}, {}, {}, "GREY"), "GREY", 1280, 720, 30);
}

TEST(CameraMode, FindsNothingAmongFormatsThatCannotBeDecoded) {
  const Modes modes{{"H264", 1280, 720, {30}}, {"RGGB", 1280, 720, {30}}};
  EXPECT_FALSE(choose_mode(modes, {}));
  EXPECT_FALSE(choose_mode({}, {}));
  EXPECT_FALSE(choose_mode(kWebcam, request({}, {}, {}, "NV12")));
}

TEST(CameraMode, IsDescribedAsPeopleWriteIt) {
  EXPECT_EQ(describe(kWebcam[0]), "YUYV 640x480 at 30, 20, 15");
  EXPECT_EQ(describe({"NV12", 64, 48, {60, 1}, true}), "NV12 64x48 at 1 to 60");
  EXPECT_EQ(describe({"GREY", 64, 48, {}}), "GREY 64x48");
}

}  // namespace
}  // namespace ar
