#pragma once

#include <opencv2/core.hpp>

#include "calib/solve/projection.h"

namespace calib {

// Where a corner's derivatives are wanted; row by row, two rows each.
struct CornerJacobians {
  double* by_intrinsics = nullptr;  // intrinsics_count() columns
  double* by_pose = nullptr;        // 6
  double* by_point = nullptr;       // 3, of the point on the board
};

// Predicted less measured pixel of a point of the board. `pose`: rotation vector and translation, camera from board.
// False where the point is not before the camera.
bool corner_error(LensChoice lens, const cv::Point2d& measured_px, const double* intrinsics, const double* pose,
                  const cv::Vec3d& on_board, double* error_px, const CornerJacobians& jacobians);

}  // namespace calib
