#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>

#include "ar/track/camera.h"

namespace ar {

// A camera model made ready for many evaluations: checked once, its invertible range found once.
//
// Every lens here bends a ray by a radial function first (of r = tan of the angle off the axis, or of the angle itself
// for Fisheye). Real coefficients are fitted over the picture only; beyond it the polynomial may turn back, so that two
// rays share a pixel. The range ends where the radial function stops growing; nothing beyond it is answered.
class Lens {
 public:
  // Throws std::runtime_error when the model cannot be one: a focal length that is not positive, a value that is not
  // finite, a number of coefficients that the lens does not take.
  explicit Lens(const CameraModel& camera);

  // Pixel of a ray with ideal coordinates (x/z, y/z); nothing beyond the range.
  std::optional<cv::Point2d> pixel_from_ideal(const cv::Point2d& ideal) const;

  // Pixel of a point in the camera's frame; nothing where z <= 0 or beyond the range. `jacobian`, where given, receives
  // d(pixel) / d(point), px per metre.
  std::optional<cv::Point2d> project(const cv::Vec3d& point_in_camera, cv::Matx23d* jacobian = nullptr) const;

  // The ray (x/z, y/z) that lands on a pixel; nothing where no ray within the range does.
  std::optional<cv::Point2d> ideal_from_pixel(const cv::Point2d& pixel) const;

  // Largest tan(angle off the axis) at which the model still has an inverse; infinite for LensModel::None.
  double max_ideal_radius() const { return max_ideal_radius_; }

  // Whether straight edges may come out bent.
  bool bends_lines() const { return lens_ != LensModel::None; }

 private:
  double radial(double r) const;              // distorted radius of ideal radius r
  double invert_radial(double radius) const;  // ideal radius within the range
  double find_max_ideal_radius() const;

  LensModel lens_;
  cv::Matx33d intrinsics_;
  std::array<double, 14> k_{};             // OpenCV's order, zero where not given
  cv::Matx33d tilt_ = cv::Matx33d::eye();  // of the sensor, k_[12], k_[13]
  bool tilted_ = false;
  double max_ideal_radius_ = 0.0;
};

}  // namespace ar
