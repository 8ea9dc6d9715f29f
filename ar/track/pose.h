#pragma once

#include <opencv2/core.hpp>

namespace ar {

// A rigid transform x_in_b = rotation * x_in_a + translation.
struct Rigid3 {
  cv::Matx33d rotation = cv::Matx33d::eye();
  cv::Vec3d translation{0.0, 0.0, 0.0};

  cv::Vec3d operator*(const cv::Vec3d& x) const { return rotation * x + translation; }
  Rigid3 operator*(const Rigid3& b) const { return {rotation * b.rotation, rotation * b.translation + translation}; }
  Rigid3 inverse() const { return {rotation.t(), -(rotation.t() * translation)}; }
};

// Unit quaternion (w, x, y, z), w >= 0, of a rotation matrix, and back.
cv::Vec4d quaternion_wxyz(const cv::Matx33d& rotation);
cv::Matx33d rotation_from_quaternion_wxyz(const cv::Vec4d& wxyz);

}  // namespace ar
