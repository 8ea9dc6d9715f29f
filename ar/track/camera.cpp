#include "ar/track/camera.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "ar/track/lens.h"
#include "render/base/check.h"

namespace ar {
namespace {

const cv::Point2d kNowhere(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN());

}  // namespace

CameraModel camera_from_horizontal_fov(int width, int height, double fov_rad, double sample_aspect) {
  CHECK(width > 0);
  CHECK(height > 0);
  CHECK(fov_rad > 0.0);
  CHECK(fov_rad < CV_PI);
  CHECK(sample_aspect > 0.0);
  const double fx = 0.5 * width / std::tan(0.5 * fov_rad);
  CameraModel camera;
  camera.width = width;
  camera.height = height;
  // A pixel that is wider than high covers more of the scene across: fewer px per radian that way.
  camera.intrinsics = {fx, 0.0, 0.5 * (width - 1), 0.0, fx * sample_aspect, 0.5 * (height - 1), 0.0, 0.0, 1.0};
  camera.origin = fmt::format("assumed pinhole, {:.1f} deg across", fov_rad * 180.0 / CV_PI);
  return camera;
}

std::vector<cv::Point2d> project(const CameraModel& camera, const std::vector<cv::Point3d>& points_in_camera) {
  const Lens lens(camera);
  std::vector<cv::Point2d> pixels;
  pixels.reserve(points_in_camera.size());
  for (const cv::Point3d& p : points_in_camera) pixels.push_back(lens.project({p.x, p.y, p.z}).value_or(kNowhere));
  return pixels;
}

std::vector<cv::Point2d> undistort_to_ideal(const CameraModel& camera, const std::vector<cv::Point2d>& pixels) {
  const Lens lens(camera);
  std::vector<cv::Point2d> ideal;
  ideal.reserve(pixels.size());
  for (const cv::Point2d& p : pixels) ideal.push_back(lens.ideal_from_pixel(p).value_or(kNowhere));
  return ideal;
}

CameraModel scaled(const CameraModel& camera, int width, int height) {
  const double sx = static_cast<double>(width) / camera.width;
  const double sy = static_cast<double>(height) / camera.height;
  if (!(camera.width > 0 && camera.height > 0 && width > 0 && height > 0 && std::abs(sx / sy - 1.0) <= 0.005)) {
    throw std::runtime_error(
        fmt::format("camera {} is for {}x{} px, the picture has {}x{}: another shape\n"
                    "calibrate the camera in the mode in which the picture was taken",
                    camera.origin, camera.width, camera.height, width, height));
  }
  CameraModel out = camera;
  out.width = width;
  out.height = height;
  cv::Matx33d& k = out.intrinsics;
  k(0, 0) *= sx;
  k(0, 1) *= sx;
  k(1, 1) *= sy;
  // The picture's edge, half a pixel before the centre of the first pixel, is what both sizes share.
  k(0, 2) = (k(0, 2) + 0.5) * sx - 0.5;
  k(1, 2) = (k(1, 2) + 0.5) * sy - 0.5;
  return out;
}

}  // namespace ar
