#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "calib/boards/board.h"
#include "calib/boards/observation.h"
#include "calib/solve/lens_choice.h"

namespace calib {

// All that a calibration varies, and what it is held against.
struct Bundle {
  const Board* board = nullptr;
  LensChoice lens = LensChoice::Pinhole;
  std::vector<double> intrinsics;
  std::vector<std::array<double, 6>> poses;    // rotation vector and translation, camera from board; by view
  std::vector<std::array<double, 3>> offsets;  // of the board's points, m
  std::vector<const Observation*> views;
  std::vector<std::vector<cv::Point2d>> px;  // measured, freed of what bent edges do to tags' corners
  std::vector<std::vector<bool>> used;
  double offset_sigma_m = 0.0;
  bool free_layout = false;
  bool free_flatness = false;

  // A point of the board where it is taken to be.
  cv::Vec3d point_on_board(std::size_t point) const {
    const auto& offset = offsets[point];
    return board->points[point] + cv::Vec3d(offset[0], offset[1], offset[2]);
  }
  bool frees_offsets() const { return free_layout || free_flatness; }
};

struct MinimiseOptions {
  double robust_scale_px = 0.0;  // of Cauchy's loss; 0: squares
  // Relative change of the sum of squares at which to stop: with 1e-9 and 1,000 corners, a thousandth of a standard
  // deviation of what is sought.
  double tolerance = 1e-9;
  double noise_px = 0.2;  // of one coordinate; what the board's own errors are weighed against
  bool hold_intrinsics = false;
  bool hold_distortion = false;  // and the principal point
};

// From where the bundle stands. False when the solver gave up or ended in something that is not finite.
bool minimise(Bundle& bundle, const MinimiseOptions& options);

// Residuals measured - predicted of one view; NaN where a point cannot be projected.
std::vector<cv::Point2d> residuals(const Bundle& bundle, std::size_t view);

}  // namespace calib
