#pragma once

#include <ceres/rotation.h>

#include <cmath>

#include "calib/lens_choice.h"

namespace calib {

// OpenCV's lens formulas over any scalar, so that the solver differentiates what ar::Lens evaluates (a test compares
// the two). `v`: fx, fy, cx, cy, distortion in the order of intrinsics_names().

template <typename T>
T radial_gain(LensChoice choice, const T* k, const T& r2) {
  const T k3 = choice == LensChoice::PlumbBob5 || choice == LensChoice::Rational8 ? k[4] : T(0.0);
  const T numerator = T(1.0) + r2 * (k[0] + r2 * (k[1] + r2 * k3));
  if (choice != LensChoice::Rational8) return numerator;
  return numerator / (T(1.0) + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
}

// Gain of the angle's radius over the tangent's, of Kannala and Brandt (2006) as OpenCV writes it. At the axis the gain
// is 1 + O(r2), and the square root has no derivative there.
template <typename T>
T fisheye_gain(const T* k, const T& r2) {
  using std::atan;
  using std::sqrt;
  if (r2 < T(1e-16)) return T(1.0);
  const T r = sqrt(r2);
  const T theta = atan(r);
  const T t2 = theta * theta;
  return theta * (T(1.0) + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3])))) / r;
}

// Pixel of a point in the camera's frame; false where z <= 0.
template <typename T>
bool project_point(LensChoice choice, const T* v, const T* point, T* pixel) {
  if (point[2] <= T(0.0)) return false;
  T x = point[0] / point[2];
  T y = point[1] / point[2];
  const T r2 = x * x + y * y;
  const T* k = v + 4;
  if (choice == LensChoice::Fisheye4) {
    const T gain = fisheye_gain(k, r2);
    x *= gain;
    y *= gain;
  } else if (choice != LensChoice::Pinhole) {
    const bool tangential = choice != LensChoice::PlumbBob2;
    const T gain = radial_gain(choice, k, r2);
    const T p1 = tangential ? k[2] : T(0.0);
    const T p2 = tangential ? k[3] : T(0.0);
    const T xy2 = T(2.0) * x * y;
    const T u = x * gain + p1 * xy2 + p2 * (r2 + T(2.0) * x * x);
    y = y * gain + p2 * xy2 + p1 * (r2 + T(2.0) * y * y);
    x = u;
  }
  pixel[0] = v[0] * x + v[2];
  pixel[1] = v[1] * y + v[3];
  return true;
}

// The pixel of a point of the board.
// `pose`: rotation vector and translation, camera from board.
template <typename T>
bool project_board_point(LensChoice choice, const T* intrinsics, const T* pose, const T* on_board, T* pixel) {
  T point[3];
  ceres::AngleAxisRotatePoint(pose, on_board, point);
  for (int i = 0; i < 3; ++i) point[i] += pose[3 + i];
  return project_point(choice, intrinsics, point, pixel);
}

}  // namespace calib
