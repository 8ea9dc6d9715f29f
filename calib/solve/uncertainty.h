#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "calib/boards/observation.h"
#include "calib/solve/solver.h"

namespace calib {

// Cells of equal size over the picture, row by row.
struct Grid {
  int columns = 0;
  int rows = 0;
  int width = 0;  // of the picture, px
  int height = 0;

  std::size_t size() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  cv::Point2d middle(std::size_t cell) const;
  // The cell of a pixel within the picture; the nearest one otherwise.
  std::size_t cell_of(const cv::Point2d& px) const;
};

// A grid of about square cells, `across` of them along the longer side.
Grid make_grid(int width, int height, int across);

// How many of the solution's used corners fall in each cell.
std::vector<int> corners_in_cells(const Observations& observations, const Solution& solution, const Grid& grid);

// What the intrinsics' covariance means in the picture: standard deviation, px, of the place where a far-off direction
// is seen, in its worst direction, at the middle of each cell; NaN where the lens model has no inverse. How the camera
// is turned is not counted: poses would absorb it, so each error of the intrinsics is taken together with the small
// rotation that hides it best in the cells with corners (the idea of mrcal's differencing, Kogan, "mrcal: a camera
// calibration toolkit", section on differences). Linear in the errors.
std::vector<double> projected_sigma_px(const Solution& solution, const Grid& grid, const std::vector<int>& corners);

// A lens by its numbers.
struct LensNumbers {
  LensChoice lens = LensChoice::Pinhole;
  std::vector<double> intrinsics;
};

// The same for a covariance that is yet to come, over the whole picture: n x n, the trace of whose product with a
// covariance of the intrinsics is the mean over the cells of the variance of where a direction is seen, px2.
cv::Mat_<double> direction_moments(const LensNumbers& numbers, const Grid& grid);

// How far apart two cameras see the same far-off directions, px, at the middle of each cell of the first one's
// picture, after the rotation of the second that brings them closest over the cells with corners.
std::vector<cv::Point2d> difference_px(const ar::CameraModel& one, const ar::CameraModel& other, const Grid& grid,
                                       const std::vector<int>& corners);

}  // namespace calib
