#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace ar {

enum class LensModel { None, PlumbBob, Rational, Fisheye };

// Intrinsics in OpenCV's convention (pixel centres at integers).
struct CameraModel {
  int width = 0;
  int height = 0;
  cv::Matx33d intrinsics = cv::Matx33d::eye();  // fx 0 cx; 0 fy cy; 0 0 1
  LensModel lens = LensModel::None;
  std::vector<double> distortion;  // PlumbBob 4 or 5, Rational 8 (12, 14), Fisheye 4; OpenCV's order
  std::string origin;              // file, or what was assumed; printed at the start
};

// A pinhole of that horizontal or diagonal field of view, principal point in the middle, for pixels of that
// sample aspect (width over height). fov in (0, pi).
CameraModel camera_from_horizontal_fov(int width, int height, double fov_rad, double sample_aspect = 1.0);

// Projects points given in the camera's frame (N, metres, z > 0) to pixels (N), with distortion.
std::vector<cv::Point2d> project(const CameraModel& camera, const std::vector<cv::Point3d>& points_in_camera);

// Ideal normalised coordinates (x/z, y/z) of N distorted pixels; NaN where the model has no inverse within its range.
std::vector<cv::Point2d> undistort_to_ideal(const CameraModel& camera, const std::vector<cv::Point2d>& pixels);

// The same camera for a picture of another size: same aspect within 0.5 %, otherwise throws std::runtime_error.
CameraModel scaled(const CameraModel& camera, int width, int height);

}  // namespace ar
