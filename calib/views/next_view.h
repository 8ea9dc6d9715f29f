#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calib/boards/board.h"
#include "calib/boards/observation.h"
#include "calib/solve/uncertainty.h"

namespace calib {

// How a person holds a board, all as the picture shows it.
enum class Tilt { Facing, LeftNearer, RightNearer, TopNearer, BottomNearer };
enum class Reach { Near, Middle, Far };
struct HeldView {
  int column = 1;  // 0 left, 1 middle, 2 right of the picture
  int row = 1;     // 0 top, 1 middle, 2 bottom
  Tilt tilt = Tilt::Facing;
  Reach reach = Reach::Middle;
  bool operator==(const HeldView&) const = default;
};

// "in the upper left corner, tilted about the vertical axis (left edge nearer), near".
std::string words_of(const HeldView& view);
// Its two parts: where, and how.
std::string words_of_place(const HeldView& view);
std::string words_of_attitude(const HeldView& view);

// How a view is held, seen through a camera known about; nothing where no pose explains it.
std::optional<HeldView> held_view_of(const Board& board, const Observation& view, const ar::CameraModel& camera);

// Which view of a board would tell most about a camera, in the way of Peng and Sturm, "Calibration Wizard" (2019): of
// views that a person can be asked for, the one after which a direction is known best over the whole picture, all poses
// left free, and which shows the board where it was not yet.
class NextView {
 public:
  NextView(const Board& board, int width, int height);

  // What is known about the camera by now; before, a usual one is assumed.
  void set_camera(const ar::CameraModel& camera);
  const ar::CameraModel& camera() const { return camera_; }
  // Counts for what was taken; a view that no pose explains says nothing.
  void set_taken(const std::vector<Observation>& taken);

  // The most telling view that was not taken yet; `corners`: of the views taken, by cell of the grid.
  HeldView best(const Grid& grid, const std::vector<int>& corners) const;
  // Root of the mean variance over the picture of where a direction is seen, px, for corners of `noise_px`.
  double expected_sigma_px(double noise_px) const;
  // What expected_sigma_px() would be with such a view taken too, over what it is; nothing where the board does not fit
  // into the picture so.
  std::optional<double> shrinks_to(const HeldView& view) const;
  // Where all the board's points would be seen then, px; nothing where it does not fit.
  std::optional<std::vector<cv::Point2d>> points_px(const HeldView& view) const;

 private:
  struct Candidate;
  std::optional<Candidate> posed(const HeldView& view) const;
  double shrinks_to(const Candidate& candidate) const;
  int new_manners(const HeldView& view) const;
  double mean_variance(const cv::Mat_<double>& information) const;

  const Board& board_;
  Grid grid_;
  ar::CameraModel camera_;
  LensNumbers numbers_;
  cv::Mat_<double> moments_;
  cv::Mat_<double> information_;  // with what is known of any camera
  std::vector<HeldView> taken_;
};

}  // namespace calib
