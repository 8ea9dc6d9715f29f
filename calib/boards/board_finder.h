#pragma once

#include <memory>
#include <opencv2/core.hpp>

#include "calib/boards/board.h"
#include "calib/boards/observation.h"

namespace calib {

// How hard a chessboard is looked for. Where none is, a thorough search may take seconds in a picture full of detail;
// of many pictures, those count in which the quick one finds it.
enum class Effort { Thorough, Quick };

// Finds a board's points in pictures, to a fraction of a pixel. Tag boards and ChArUco may be seen in part; a
// chessboard must be seen whole, because nothing tells which part is seen. Not thread-safe.
class BoardFinder {
 public:
  // `threads` of the tag detector. The board must outlive the finder.
  explicit BoardFinder(const Board& board, int threads = 1);
  ~BoardFinder();
  BoardFinder(const BoardFinder&) = delete;
  BoardFinder& operator=(const BoardFinder&) = delete;

  // No points where the board is not seen. `name` and `time_s` are left to the caller.
  Observation find(const cv::Mat& grey8, Effort effort = Effort::Thorough);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Moves points to the saddles of brightness near them. `reach_px`: half the window of each, less than the distance to
// the next edge that does not run through the point. A point that leaves its window is NaN.
void refine_saddles(const cv::Mat& grey8, std::vector<cv::Point2d>& px, const std::vector<double>& reach_px);

// Median over the points of (brightest - darkest) / steepest slope within `radius` px: how many pixels an edge takes.
double edge_width_px(const cv::Mat& grey8, const std::vector<cv::Point2d>& px, int radius);

}  // namespace calib
