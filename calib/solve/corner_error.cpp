#include "calib/solve/corner_error.h"

namespace calib {
namespace {

template <int N>
void store(const cv::Matx<double, 2, N>& from, double* to) {
  for (int i = 0; i < 2 * N; ++i) to[i] = from.val[i];
}

}  // namespace

bool corner_error(LensChoice lens, const cv::Point2d& measured_px, const double* intrinsics, const double* pose,
                  const cv::Vec3d& on_board, double* error_px, const CornerJacobians& jacobians) {
  const bool geometry = jacobians.by_pose != nullptr || jacobians.by_point != nullptr;
  cv::Matx<double, 3, 6> by_pose;
  cv::Matx33d rotation;
  const cv::Vec3d in_camera = geometry ? transformed(pose, on_board, &by_pose, &rotation) : transformed(pose, on_board);
  cv::Matx23d px_by_point;
  if (!project_point(lens, intrinsics, in_camera.val, error_px, jacobians.by_intrinsics,
                     geometry ? px_by_point.val : nullptr)) {
    return false;
  }
  error_px[0] -= measured_px.x;
  error_px[1] -= measured_px.y;
  if (jacobians.by_pose != nullptr) store<6>(px_by_point * by_pose, jacobians.by_pose);
  if (jacobians.by_point != nullptr) store<3>(px_by_point * rotation, jacobians.by_point);
  return true;
}

}  // namespace calib
