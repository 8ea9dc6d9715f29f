#include "ar/track/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <random>

#include "ar/track/lens.h"

namespace ar {
namespace {

CameraModel camera_with(LensModel lens, std::vector<double> distortion) {
  CameraModel camera;
  camera.width = 1280;
  camera.height = 720;
  camera.intrinsics = {900.0, 0.0, 645.0, 0.0, 905.0, 355.0, 0.0, 0.0, 1.0};
  camera.lens = lens;
  camera.distortion = std::move(distortion);
  return camera;
}

std::vector<CameraModel> cameras() {
  return {camera_with(LensModel::None, {}),
          camera_with(LensModel::PlumbBob, {-0.28, 0.09, 0.001, -0.0005}),
          camera_with(LensModel::PlumbBob, {0.12, -0.2, -0.002, 0.001, 0.08}),
          camera_with(LensModel::Rational, {0.4, -0.1, 0.0005, -0.0003, 0.02, 0.75, 0.05, 0.01}),
          camera_with(LensModel::Rational,
                      {0.4, -0.1, 0.0005, -0.0003, 0.02, 0.75, 0.05, 0.01, 0.001, -0.0004, 0.0007, 0.0002}),
          camera_with(LensModel::Rational, {0.4, -0.1, 0.0005, -0.0003, 0.02, 0.75, 0.05, 0.01, 0.001, -0.0004, 0.0007,
                                            0.0002, 0.02, -0.03}),
          camera_with(LensModel::Fisheye, {-0.03, 0.004, -0.001, 0.0002})};
}

std::vector<cv::Point3d> some_points() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> across(-0.6, 0.6);
  std::uniform_real_distribution<double> away(0.3, 9.0);
  std::vector<cv::Point3d> points{{0.0, 0.0, 2.0}};
  for (int i = 0; i < 200; ++i) {
    const double z = away(random);
    points.emplace_back(across(random) * z, 0.6 * across(random) * z, z);
  }
  return points;
}

TEST(CameraModel, ProjectsAsOpenCvDoes) {
  const std::vector<cv::Point3d> points = some_points();
  for (const CameraModel& camera : cameras()) {
    std::vector<cv::Point2d> expected;
    const cv::Vec3d zero(0.0, 0.0, 0.0);
    if (camera.lens == LensModel::Fisheye) {
      cv::fisheye::projectPoints(points, expected, zero, zero, camera.intrinsics, camera.distortion);
    } else {
      cv::projectPoints(points, zero, zero, camera.intrinsics, camera.distortion, expected);
    }
    const std::vector<cv::Point2d> found = project(camera, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_NEAR(found[i].x, expected[i].x, 1e-8) << camera.distortion.size() << " coefficients, point " << i;
      EXPECT_NEAR(found[i].y, expected[i].y, 1e-8);
    }
  }
}

TEST(CameraModel, UndistortionIsTheInverseOfProjection) {
  const std::vector<cv::Point3d> points = some_points();
  for (const CameraModel& camera : cameras()) {
    const std::vector<cv::Point2d> ideal = undistort_to_ideal(camera, project(camera, points));
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_NEAR(ideal[i].x, points[i].x / points[i].z, 1e-9) << camera.distortion.size() << " coefficients";
      EXPECT_NEAR(ideal[i].y, points[i].y / points[i].z, 1e-9);
    }
  }
}

TEST(CameraModel, JacobianAgreesWithFiniteDifferences) {
  for (const CameraModel& camera : cameras()) {
    const Lens lens(camera);
    for (const cv::Point3d& p : some_points()) {
      const cv::Vec3d x(p.x, p.y, p.z);
      cv::Matx23d jacobian;
      ASSERT_TRUE(lens.project(x, &jacobian));
      for (int axis = 0; axis < 3; ++axis) {
        const double h = 1e-6;
        cv::Vec3d step(0, 0, 0);
        step[axis] = h;
        const cv::Point2d slope = (*lens.project(x + step) - *lens.project(x - step)) / (2.0 * h);
        const double tolerance = 1e-5 * (1.0 + cv::norm(slope));  // central differences of values near 1e3 px
        EXPECT_NEAR(jacobian(0, axis), slope.x, tolerance);
        EXPECT_NEAR(jacobian(1, axis), slope.y, tolerance);
      }
    }
  }
}

TEST(CameraModel, NoInverseWhereTheRadialPolynomialTurnsBack) {
  // r (1 - 0.3 r^2) grows up to r = 1.0541 and reaches 0.7027 there; no ray lands farther out.
  const CameraModel camera = camera_with(LensModel::PlumbBob, {-0.3, 0.0, 0.0, 0.0});
  const Lens lens(camera);
  EXPECT_NEAR(lens.max_ideal_radius(), std::sqrt(1.0 / 0.9), 1e-5);
  const double edge_px = 900.0 * 0.70273;
  const auto ideal = undistort_to_ideal(camera, {{645.0 + edge_px - 1.0, 355.0}, {645.0 + edge_px + 1.0, 355.0}});
  EXPECT_NEAR(ideal[0].x, 1.0, 0.1);
  EXPECT_TRUE(std::isnan(ideal[1].x) && std::isnan(ideal[1].y));
  EXPECT_TRUE(std::isnan(project(camera, {{2.0, 0.0, 1.0}})[0].x)) << "it would fold back into the picture";
}

TEST(CameraModel, PolesOfTheRationalModelEndItsRange) {
  const Lens lens(camera_with(LensModel::Rational, {0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0}));
  EXPECT_LE(lens.max_ideal_radius(), 1.0);
  EXPECT_GT(lens.max_ideal_radius(), 0.99);
}

TEST(CameraModel, NothingBehindTheCameraHasAPixel) {
  for (const CameraModel& camera : cameras()) {
    for (const cv::Point2d& p : project(camera, {{0.1, 0.1, -1.0}, {0.1, 0.1, 0.0}})) {
      EXPECT_TRUE(std::isnan(p.x) && std::isnan(p.y));
    }
  }
}

TEST(CameraModel, FieldOfViewReachesFromEdgeToEdge) {
  const CameraModel camera = camera_from_horizontal_fov(1280, 720, 1.0);
  // OpenCV counts from the centre of the first pixel: the picture's edges are at -0.5 and 1279.5.
  const auto pixels = project(camera, {{-std::tan(0.5), 0.0, 1.0}, {std::tan(0.5), 0.0, 1.0}});
  EXPECT_NEAR(pixels[0].x, -0.5, 1e-9);
  EXPECT_NEAR(pixels[1].x, 1279.5, 1e-9);
  EXPECT_NEAR(pixels[0].y, 359.5, 1e-9);
}

TEST(CameraModel, WidePixelsCoverMoreAcross) {
  // 720 x 576 shown at 16:9: square pixels would make 1024 x 576.
  const double aspect = 64.0 / 45.0;
  const CameraModel camera = camera_from_horizontal_fov(720, 576, 1.0, aspect);
  EXPECT_NEAR(camera.intrinsics(1, 1) / camera.intrinsics(0, 0), aspect, 1e-12);
}

TEST(CameraModel, ScalingKeepsTheRayOfThePicturesEdge) {
  const CameraModel full = camera_with(LensModel::PlumbBob, {-0.28, 0.09, 0.001, -0.0005});
  const CameraModel half = scaled(full, 640, 360);
  const cv::Point2d in_full = undistort_to_ideal(full, {{1279.5, 719.5}})[0];
  const cv::Point2d in_half = undistort_to_ideal(half, {{639.5, 359.5}})[0];
  EXPECT_NEAR(in_full.x, in_half.x, 1e-12);
  EXPECT_NEAR(in_full.y, in_half.y, 1e-12);
}

TEST(CameraModel, AnotherShapeIsRefused) {
  const CameraModel camera = camera_with(LensModel::None, {});
  EXPECT_NO_THROW(scaled(camera, 1920, 1080));
  EXPECT_NO_THROW(scaled(camera, 854, 480));  // 16:9 rounded to even numbers
  EXPECT_THROW(scaled(camera, 640, 480), std::runtime_error);
}

TEST(CameraModel, ModelsThatAreNoneAreRefused) {
  EXPECT_THROW(Lens(camera_with(LensModel::PlumbBob, {0.1})), std::runtime_error);
  EXPECT_THROW(Lens(camera_with(LensModel::Fisheye, {0.1, 0.0, 0.0, std::nan("")})), std::runtime_error);
  CameraModel flat = camera_with(LensModel::None, {});
  flat.intrinsics(0, 0) = 0.0;
  EXPECT_THROW(Lens{flat}, std::runtime_error);
}

}  // namespace
}  // namespace ar
