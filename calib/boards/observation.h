#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "calib/boards/board.h"

namespace calib {

// What one picture shows of a board.
struct Observation {
  std::string name;              // picture, or video and frame
  double time_s = 0.0;           // of a video's frame
  std::vector<int> points;       // of the board, rising
  std::vector<cv::Point2d> px;   // their places, OpenCV's count
  std::vector<int> foreign_ids;  // tags of the board's family that are not on the board
  double edge_width_px = 0.0;    // median rise of the edges from dark to light at the points: 1 to 2 is sharp
};

// Pictures of one size that show a board.
struct Observations {
  int width = 0;
  int height = 0;
  std::vector<Observation> views;
};

// Whether the tags' corners are crossings of fitted lines, which a bent edge displaces (see ar::straighten()).
inline bool corners_cross_edges(const Board& board) {
  return board.kind == BoardKind::Tags && board.filled_gap_m == 0.0;
}

}  // namespace calib
