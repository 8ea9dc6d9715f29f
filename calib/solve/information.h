#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "calib/solve/bundle.h"
#include "calib/solve/projection.h"

namespace calib {

// Inverse of the intrinsics' information, poses and board errors left free, for corners of 1 px noise (multiply by the
// noise's variance): the inverse of the Schur complement of the normal equations. Infinite diagonal where singular.
struct Information {
  cv::Mat_<double> covariance;
  double conditioning = 0.0;  // smallest over largest eigenvalue of the information scaled to unit diagonal
};
Information intrinsics_information(const Bundle& bundle, double noise_px);

// What the corners of one view say about the intrinsics, its pose left free, for noise of 1 px: intrinsics_count() rows
// and columns, to be added up over views. Points that cannot be projected say nothing.
cv::Mat_<double> view_information(LensChoice lens, const std::vector<double>& intrinsics,
                                  const PoseNumbers& camera_from_board, const std::vector<cv::Vec3d>& points);

}  // namespace calib
