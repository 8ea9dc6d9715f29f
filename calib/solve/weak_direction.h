#pragma once

#include <opencv2/core.hpp>

#include "calib/solve/bundle.h"

namespace calib {

// A covariance from derivatives at the solution tells the truth as long as the formulas are straight over its reach.
// Along a weakly determined combination of intrinsics they are not: the rational lens's numerator and denominator may
// grow together, and how freely depends on how large they are. Follows that combination, everything else fitted anew,
// to where the sum of squares has grown by nine variances (three standard deviations), both ways, and widens the
// covariance so that its three standard deviations reach there. Poses are left free to first order.
// `covariance`: of the intrinsics, for noise of sigma_px; returned as it is where the formulas are straight enough.
cv::Mat_<double> widened_along_weakest(const Bundle& bundle, const cv::Mat_<double>& covariance, double sigma_px);

}  // namespace calib
