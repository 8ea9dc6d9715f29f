#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "ar/track/pose.h"
#include "calib/solve/lens_choice.h"

namespace calib {

// OpenCV's lens formulas with their derivatives, so that the solver knows what ar::Lens evaluates (tests compare the
// two, and the derivatives with differences). `v`: fx, fy, cx, cy, distortion in the order of intrinsics_names().

// Pixel of a point in the camera's frame; false where z <= 0. Where asked for, row by row: by_intrinsics, 2 x
// intrinsics_count(); by_point, 2 x 3.
bool project_point(LensChoice choice, const double* v, const double* point, double* pixel,
                   double* by_intrinsics = nullptr, double* by_point = nullptr);

// A pose as solvers take it: rotation vector and translation.
using PoseNumbers = std::array<double, 6>;
PoseNumbers numbers_of(const ar::Rigid3& pose);
ar::Rigid3 pose_of(const PoseNumbers& numbers);

// A rotation vector's matrix, and what a change of the vector does: d(R p) = -[R p]x * left * d(vector), with the left
// Jacobian of SO(3) (Sola, Deray and Atchuthan, "A micro Lie theory", 2018, equation 145).
struct Turn {
  explicit Turn(const double* vector);
  cv::Matx33d rotation;
  cv::Matx33d left;

  // 3 x 3; `turned` is rotation * p.
  cv::Matx33d by_vector(const cv::Vec3d& turned) const;
};

// `pose`: rotation vector and translation, b from a. The point in b and, where asked for, its derivatives by the pose's
// six numbers.
cv::Vec3d transformed(const double* pose, const cv::Vec3d& in_a, cv::Matx<double, 3, 6>* by_pose = nullptr,
                      cv::Matx33d* by_point = nullptr);

}  // namespace calib
