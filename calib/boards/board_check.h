#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calib/boards/board.h"
#include "calib/boards/observation.h"

namespace calib {

// Where the pictures put a tag relative to another one, against what the board says, in sizes of the first tag.
struct TagStep {
  int from_id = 0;
  int to_id = 0;
  cv::Point2d measured;  // median over the views: right, down
  cv::Point2d expected;
  double error() const { return cv::norm(measured - expected); }
};

// Every tag of a flat board against its nearest neighbours, measured with the first tag's own four corners as the
// ruler; steps that fewer than `fewest_views` views show are left out. Worst first. Empty for other boards.
std::vector<TagStep> compare_steps(const Board& board, const std::vector<Observation>& views, int fewest_views);

// Whether the pictures show another board than the file says: the step that tells it, where most steps that could be
// measured are off by more than `tolerance` tag sizes, or by as much in the same way.
std::optional<TagStep> wrong_step(const Board& board, const std::vector<Observation>& views, double tolerance);

// What else may be in a picture in which the board was not found.
struct OtherBoard {
  std::string family;     // of tags that are there but not the board's; empty: none
  std::vector<int> ids;   // of those tags
  bool mirrored = false;  // the board is found in the mirrored picture
  cv::Size chessboard;    // inner corners of a chessboard of another size; 0 x 0: none
};
OtherBoard look_for_others(const Board& board, const cv::Mat& grey8);

}  // namespace calib
