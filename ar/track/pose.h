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

// Rotation by |v| rad about v (Rodrigues), and back (|v| <= pi). Stable at zero and at half a turn.
cv::Matx33d rotation_from_vector(const cv::Vec3d& v);
cv::Vec3d vector_from_rotation(const cv::Matx33d& rotation);
// Angle of the rotation that takes one to the other, rad, 0 ... pi.
double angle_between(const cv::Matx33d& a, const cv::Matx33d& b);
// The matrix of v x (...).
cv::Matx33d cross_matrix(const cv::Vec3d& v);

// A small step of a pose b_from_a, (rotation vector rad, translation m), both along the axes of b: turns first, then
// adds. The errors and covariances of poses are in these six coordinates.
Rigid3 moved(const Rigid3& pose, const cv::Vec6d& step);
cv::Vec6d step_between(const Rigid3& from, const Rigid3& to);

}  // namespace ar
