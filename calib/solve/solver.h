#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ar/track/camera.h"
#include "calib/boards/board.h"
#include "calib/boards/observation.h"
#include "calib/solve/lens_choice.h"

namespace calib {

struct SolveOptions {
  LensChoice lens = LensChoice::PlumbBob5;
  bool reject_outliers = true;
  // Errors of the board that are solved for as well, each coordinate expected to be off by `board_sigma_m`.
  bool solve_layout = false;    // in the plane of the board
  bool solve_flatness = false;  // out of it
  double board_sigma_m = 0.0;   // 0: 1 % of the board's unit
  // A camera known about: spares the search for starting values.
  std::optional<ar::CameraModel> start;
};

// How a solution explains one view.
struct ViewFit {
  ar::Rigid3 camera_from_board;
  std::vector<cv::Point2d> residual_px;  // measured - predicted, by point of the observation
  std::vector<bool> used;                // the others are outliers
  double rms_px = 0.0;                   // of the used points: root of the mean squared distance
  bool any_used() const;
};

struct Solution {
  LensChoice lens = LensChoice::Pinhole;
  std::vector<double> intrinsics;  // as intrinsics_names()
  // Of the intrinsics; infinite on the diagonal where they are undetermined. The first tells how far each number may be
  // off, the way to where it may be being curved (see widened_along_weakest()); the second is what the derivatives at
  // the solution say, right for what changes in proportion, such as the picture's places.
  cv::Mat_<double> covariance;
  cv::Mat_<double> local_covariance;
  ar::CameraModel camera;
  std::vector<ViewFit> views;          // as the observations
  std::vector<cv::Vec3d> board_error;  // solved displacement of each of the board's points, m; empty when not solved
  double rms_px = 0.0;                 // root of the mean squared distance of the used points
  double sigma_px = 0.0;               // noise of one coordinate, from the residuals and their degrees of freedom
  int points_used = 0;
  int points_rejected = 0;
  // Weakest direction of the intrinsics' information, scaled to unit diagonal, against the strongest: near 0, some
  // combination of them is not determined by the views.
  double conditioning = 0.0;

  double sigma_of(int intrinsic) const;
  // Views of which any corner is used.
  std::vector<std::size_t> used_views() const;
};

// Least squares over all corners of all views: finds starting values, bounds the influence of corners that do not fit
// (Cauchy), leaves them out, and solves once more. Views of fewer than 4 points count for nothing. nullopt when no
// start explains any view or the solver ends in nothing finite.
std::optional<Solution> solve(const Board& board, const Observations& observations, const SolveOptions& options);

// The pose of a view of the board, camera known, and its root of the mean squared distance over `used` points.
struct PoseFit {
  ar::Rigid3 camera_from_board;
  double rms_px = 0.0;
};
std::optional<PoseFit> fit_view(const Board& board, const Observation& view, const std::vector<bool>& used,
                                const ar::CameraModel& camera);

}  // namespace calib
