#include "ar/track/pose.h"

#include <cmath>

#include "render/base/check.h"

namespace ar {

// Shepperd's method: divides by the largest of the four, so it is stable at every angle.
cv::Vec4d quaternion_wxyz(const cv::Matx33d& r) {
  const double trace = r(0, 0) + r(1, 1) + r(2, 2);
  cv::Vec4d q;
  if (trace >= r(0, 0) && trace >= r(1, 1) && trace >= r(2, 2)) {
    q = {1.0 + trace, r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)};
  } else if (r(0, 0) >= r(1, 1) && r(0, 0) >= r(2, 2)) {
    q = {r(2, 1) - r(1, 2), 1.0 + r(0, 0) - r(1, 1) - r(2, 2), r(0, 1) + r(1, 0), r(0, 2) + r(2, 0)};
  } else if (r(1, 1) >= r(2, 2)) {
    q = {r(0, 2) - r(2, 0), r(0, 1) + r(1, 0), 1.0 - r(0, 0) + r(1, 1) - r(2, 2), r(1, 2) + r(2, 1)};
  } else {
    q = {r(1, 0) - r(0, 1), r(0, 2) + r(2, 0), r(1, 2) + r(2, 1), 1.0 - r(0, 0) - r(1, 1) + r(2, 2)};
  }
  q /= cv::norm(q);
  return q[0] < 0.0 ? -q : q;
}

cv::Matx33d rotation_from_quaternion_wxyz(const cv::Vec4d& wxyz) {
  const double length = cv::norm(wxyz);
  CHECK(length > 0.0);
  const double w = wxyz[0] / length;
  const double x = wxyz[1] / length;
  const double y = wxyz[2] / length;
  const double z = wxyz[3] / length;
  return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
          2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
          2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
}

cv::Matx33d rotation_from_vector(const cv::Vec3d& v) {
  const double angle = cv::norm(v);
  const double half = 0.5 * angle;
  const double scale = half < 1e-6 ? 0.5 * (1.0 - half * half / 6.0) : std::sin(half) / angle;
  return rotation_from_quaternion_wxyz({std::cos(half), scale * v[0], scale * v[1], scale * v[2]});
}

cv::Vec3d vector_from_rotation(const cv::Matx33d& rotation) {
  const cv::Vec4d q = quaternion_wxyz(rotation);
  const cv::Vec3d axis(q[1], q[2], q[3]);
  const double sine = cv::norm(axis);
  const double scale = sine < 1e-9 ? 2.0 : 2.0 * std::atan2(sine, q[0]) / sine;
  return scale * axis;
}

double angle_between(const cv::Matx33d& a, const cv::Matx33d& b) {
  return cv::norm(vector_from_rotation(a * b.t()));
}

cv::Matx33d cross_matrix(const cv::Vec3d& v) {
  return {0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0};
}

Rigid3 moved(const Rigid3& pose, const cv::Vec6d& step) {
  return {rotation_from_vector({step[0], step[1], step[2]}) * pose.rotation,
          pose.translation + cv::Vec3d(step[3], step[4], step[5])};
}

cv::Vec6d step_between(const Rigid3& from, const Rigid3& to) {
  const cv::Vec3d turn = vector_from_rotation(to.rotation * from.rotation.t());
  const cv::Vec3d shift = to.translation - from.translation;
  return {turn[0], turn[1], turn[2], shift[0], shift[1], shift[2]};
}

}  // namespace ar
