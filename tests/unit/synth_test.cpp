// The filmed world against what is known of it: where the camera is, where tags appear, what blur and seeds do.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <sstream>

#include "app/synth/film.h"
#include "app/synth/path.h"
#include "app/synth/raycast.h"
#include "app/synth/spec.h"
#include "app/synth/world.h"
#include "ar/track/detector.h"
#include "ar/track/tag_face.h"

namespace app::synth {
namespace {

// A tag on plain ground before a still camera; small, so that it renders in a moment.
Spec plain_spec() {
  Spec spec;
  spec.width = 480;
  spec.height = 360;
  spec.frames = 2;
  spec.latitude_deg = 45.0;
  spec.time = std::chrono::sys_days(std::chrono::June / 21 / 2024) + std::chrono::hours(10);
  spec.shutter_s = 0.0;
  spec.camera = ar::camera_from_horizontal_fov(spec.width, spec.height, 1.1);
  spec.path.keys = {{0.0, {0.4, -1.6, 1.3}, {0.05, 0.02, 0.0}}};
  spec.ground.surface = "plain";
  spec.ground.around = "plain";
  spec.tags.tags[5] = {ar::flat_tag({0.0, 0.0, 0.01}, 0.2), 0.6};
  return spec;
}

std::vector<std::uint8_t> filmed_luma(const Spec& spec, int frame) {
  const CameraPath path(spec.path, spec.time_of_frame_s(spec.frames - 1), spec.seed);
  const World world(spec, {0.4F, -1.6F, 1.3F}, {0.0F, 0.0F, 0.0F});
  const auto width = static_cast<std::size_t>(spec.width);
  const auto height = static_cast<std::size_t>(spec.height);
  std::vector<std::uint8_t> luma(width * height);
  std::vector<std::uint8_t> cb(width * height / 4);
  std::vector<std::uint8_t> cr(width * height / 4);
  ar::OutputFrame planes;
  planes.format.width = spec.width;
  planes.format.height = spec.height;
  planes.plane = {luma.data(), cb.data(), cr.data()};
  planes.stride_bytes = {spec.width, spec.width / 2, spec.width / 2};
  Film(spec).develop(RayCaster(spec, world, path).render(frame), frame, planes);
  return luma;
}

std::array<cv::Point2d, 4> true_corners(const Spec& spec, double time_s) {
  const CameraPath path(spec.path, spec.time_of_frame_s(spec.frames - 1), spec.seed);
  const ar::Rigid3 camera_from_tag = path.world_from_camera(time_s).inverse() * spec.tags.tags.at(5).world_from_tag;
  std::vector<cv::Point3d> points;
  for (const cv::Vec3d& corner : ar::corners_in_tag(spec.tags.tags.at(5).size_m))
    points.emplace_back(camera_from_tag * corner);
  const auto pixels = ar::project(spec.camera, points);
  return {pixels[0], pixels[1], pixels[2], pixels[3]};
}

// The light itself in 8 bits: a camera's transfer function lets white grow over black, and finders then see the black
// border smaller all round by a tenth or two of a pixel. That is the finder's affair; here the geometry is tested.
cv::Mat linear_gray(const Spec& spec, int frame) {
  const CameraPath path(spec.path, spec.time_of_frame_s(spec.frames - 1), spec.seed);
  const World world(spec, {0.4F, -1.6F, 1.3F}, {0.0F, 0.0F, 0.0F});
  const LinearFrame light = RayCaster(spec, world, path).render(frame);
  cv::Mat gray(light.height, light.width, CV_8UC1);
  for (int y = 0; y < light.height; ++y) {
    for (int x = 0; x < light.width; ++x) {
      const glm::vec3& rgb = light.rgb[static_cast<std::size_t>(y * light.width + x)];
      gray.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(255.0F * rgb.g);
    }
  }
  return gray;
}

// The right tag, each corner in its own place: mean error and bias (pixels) of the found against the true corners.
void expect_found_at_truth(const Spec& spec, int frame, double tolerance_px) {
  const auto found = ar::Detector().detect(linear_gray(spec, frame));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].id, 5);
  EXPECT_EQ(found[0].hamming, 0);
  const auto truth = true_corners(spec, spec.time_of_frame_s(frame));
  double mean = 0.0;
  cv::Point2d bias;
  std::ostringstream each;
  for (std::size_t i = 0; i < 4; ++i) {
    const cv::Point2d error = found[0].corners_px[i] - truth[i];
    mean += std::hypot(error.x, error.y) / 4.0;
    bias += error / 4.0;
    each << error << ' ';
  }
  testing::Test::RecordProperty("mean_error_px", std::to_string(mean));
  EXPECT_LT(mean, tolerance_px) << "bias " << bias << ", corners off by " << each.str();
  EXPECT_LT(std::hypot(bias.x, bias.y), 0.06) << "all corners shifted alike: a convention is off";
}

TEST(SynthPath, PassesThroughItsKeysAndIsSmooth) {
  const Spline3 spline({0.0, 1.0, 2.5, 4.0}, {{0, 0, 0}, {1, 2, 0}, {3, 1, 1}, {4, 4, 0}});
  EXPECT_NEAR(glm::length(spline(2.5) - glm::dvec3(3, 1, 1)), 0.0, 1e-12);
  for (const double knot : {1.0, 2.5}) {  // the second derivative is the same from both sides
    const double h = 1e-3;
    const glm::dvec3 before = (spline(knot) - 2.0 * spline(knot - h) + spline(knot - 2.0 * h)) / (h * h);
    const glm::dvec3 after = (spline(knot + 2.0 * h) - 2.0 * spline(knot + h) + spline(knot)) / (h * h);
    EXPECT_NEAR(glm::length(after - before), 0.0, 0.05) << "at " << knot;  // third derivative times 2 h
  }
  const glm::dvec3 slope_in = (spline(4.0) - spline(4.0 - 1e-5)) / 1e-5;
  const glm::dvec3 slope_out = (spline(4.5) - spline(4.0)) / 0.5;
  EXPECT_NEAR(glm::length(slope_out - slope_in), 0.0, 1e-3);  // goes straight on after its end
}

TEST(SynthPath, CameraLooksAtItsTargetWithALevelHorizon) {
  const ar::Rigid3 pose = look_at({3.0, -2.0, 1.5}, {0.0, 1.0, 0.5});
  const cv::Vec3d target = pose.inverse() * cv::Vec3d(0.0, 1.0, 0.5);
  EXPECT_NEAR(target[0], 0.0, 1e-12);
  EXPECT_NEAR(target[1], 0.0, 1e-12);
  EXPECT_GT(target[2], 0.0);
  EXPECT_NEAR(pose.rotation(2, 0), 0.0, 1e-12) << "right axis is not level";
  EXPECT_NEAR(cv::determinant(cv::Mat(pose.rotation)), 1.0, 1e-12);
}

TEST(SynthTag, IsFoundWithItsIdAndCornersInPlace) {
  expect_found_at_truth(plain_spec(), 0, 0.1);
}

TEST(SynthTag, IsFoundInPlaceThroughADistortingLens) {
  Spec spec = plain_spec();
  spec.camera.lens = ar::LensModel::PlumbBob;
  spec.camera.distortion = {-0.18, 0.05, 0.001, -0.0008, 0.0};
  expect_found_at_truth(spec, 0, 0.15);  // straight edges fitted to slightly bent ones
}

TEST(SynthTag, MotionBlurIsCentredOnTheFramesTime) {
  Spec spec = plain_spec();
  spec.fps_num = 10;
  spec.shutter_s = 0.05;
  spec.path.keys = {{-1.0, {0.0, -1.6, 1.3}, {-0.35, 0.02, 0.0}}, {1.0, {0.8, -1.6, 1.3}, {0.45, 0.02, 0.0}}};
  spec.frames = 3;
  expect_found_at_truth(spec, 1,
                        0.25);  // blurred by some 5 px; a shutter opening at the frame's time would shift it 2.5
}

TEST(Synth, EqualSeedsGiveEqualPicturesAndOthersDoNot) {
  Spec spec = plain_spec();
  spec.width = 160;
  spec.height = 120;
  spec.camera = ar::camera_from_horizontal_fov(spec.width, spec.height, 1.1);
  spec.noise_codes = 2.0;
  const std::vector<std::uint8_t> first = filmed_luma(spec, 0);
  EXPECT_EQ(first, filmed_luma(spec, 0));
  EXPECT_NE(first, filmed_luma(spec, 1)) << "a still camera's frames differ by their noise";
}

TEST(SynthFilm, NoiseAtGreyHasTheSigmaAskedFor) {
  Spec spec;
  spec.noise_codes = 2.0;
  LinearFrame grey{256, 256, std::vector<glm::vec3>(256 * 256, glm::vec3(0.18F))};
  std::vector<std::uint8_t> y(256 * 256), cb(128 * 128), cr(128 * 128);
  ar::OutputFrame planes;
  planes.format.width = planes.format.height = 256;
  planes.plane = {y.data(), cb.data(), cr.data()};
  planes.stride_bytes = {256, 128, 128};
  Film(spec).develop(grey, 0, planes);
  cv::Scalar mean, sigma;
  cv::meanStdDev(cv::Mat(256, 256, CV_8UC1, y.data()), mean, sigma);
  EXPECT_NEAR(mean[0], 16.0 + 219.0 * bt709_encode(0.18F), 0.1);
  // Three independent channels weighted into luma, and rounding to whole codes.
  const double luma = 2.0 * std::sqrt(0.2126 * 0.2126 + 0.7152 * 0.7152 + 0.0722 * 0.0722);
  EXPECT_NEAR(sigma[0], std::sqrt(luma * luma + 1.0 / 12.0), 0.05);
}

TEST(SynthTagFace, HasAWhiteMarginAndABlackBorder) {
  const ar::TagFace face = ar::make_tag_face("tag36h11", 0, 0.8);
  EXPECT_EQ(face.cells, 12);
  EXPECT_NEAR(face.cell_m, 0.1, 1e-12);
  EXPECT_TRUE(face.is_white(-0.41, 0.0));
  EXPECT_FALSE(face.is_white(-0.39, 0.0));
  EXPECT_THROW(ar::make_tag_face("tag36h11", 587, 0.8), std::runtime_error);
}

}  // namespace
}  // namespace app::synth
