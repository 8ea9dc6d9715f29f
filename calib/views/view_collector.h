#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "calib/boards/board.h"
#include "calib/boards/observation.h"
#include "calib/solve/uncertainty.h"
#include "calib/views/next_view.h"

namespace calib {

// What became of a frame.
enum class FrameUse {
  NoBoard,  // or too little of it
  Moving,
  Blurred,
  Known,  // looks like a view that was taken
  Taken
};

// What the views taken so far show.
struct ViewCoverage {
  Grid grid;
  std::vector<int> corners;      // by cell of the picture
  double picture = 0.0;          // share of the cells with corners
  std::array<int, 5> tilts{};    // views by Tilt
  std::array<int, 3> reaches{};  // views by Reach
};

// Takes views of a board for a calibration out of pictures as they come: when it is held still, is sharp and adds
// something; and knows which view to ask for next.
class ViewCollector {
 public:
  // `most`: views after which it is enough. The board must outlive it.
  ViewCollector(const Board& board, int width, int height, std::size_t most);

  // The board in the next frame, in order of time.
  FrameUse add(const Observation& frame);
  // Takes back the last view; it is not taken again before the board has moved.
  void drop_last();

  const std::vector<Observation>& taken() const { return taken_; }
  const ViewCoverage& coverage() const { return coverage_; }
  // The view that would help most now.
  const HeldView& next() const { return next_; }
  // Where the board's points are seen in that view, px; empty where it is not known.
  const std::vector<cv::Point2d>& next_px() const { return next_px_; }
  // How the last one that was taken was held.
  const HeldView& last_held() const { return last_held_; }
  // Root of the mean variance of where a direction will be seen, px, as far as the views taken tell.
  double expected_sigma_px() const { return expected_sigma_px_; }
  // As many as asked for; or a good set: ten, over most of the picture, tilted all ways, near and farther away.
  bool enough() const;

 private:
  bool adds_something(const Observation& frame) const;
  void take(const Observation& frame);
  void look_ahead();
  void learn_camera();

  const Board& board_;
  double picture_px_;
  std::size_t most_;
  NextView planner_;
  std::vector<Observation> taken_;
  ViewCoverage coverage_;
  HeldView next_;
  std::vector<cv::Point2d> next_px_;
  HeldView last_held_;
  double expected_sigma_px_ = 0.0;
  std::optional<Observation> refused_;  // the view that was taken back, while the board is still there
  Observation anchor_;                  // since when the board has not moved
  int still_frames_ = 0;
  double sharpest_px_ = 1e9;  // narrowest edges of a still board so far
};

// "hold it still", ... for people.
const char* to_string(FrameUse use);

}  // namespace calib
