#include "calib/views/view_collector.h"

#include <algorithm>
#include <cmath>

#include "calib/solve/solver.h"
#include "calib/views/view_descriptor.h"

namespace calib {
namespace {

constexpr int kCellsAcross = 16;          // as the quality gates count
constexpr std::size_t kFewestPoints = 8;  // of a view that is worth taking
constexpr double kStillShare = 0.004;     // of the longer side, that a board held still may move meanwhile:
constexpr double kStillS = 0.3;           // 17 px/s at 1280, half a pixel of blur in 1/30 s
constexpr int kStillFrames = 3;
constexpr double kNew = 0.08;     // of view descriptors: a twelfth of the picture, or 5 degrees
constexpr double kSharpPx = 3.0;  // edges narrower than that are sharp anyway
constexpr double kBlurRatio = 1.4;
constexpr std::size_t kGoodSet = 10;
constexpr double kWellCovered = 0.6;        // as the quality gates ask for
constexpr std::size_t kViewsForCamera = 4;  // that tell about a camera at all
constexpr double kExpectedNoisePx = 0.2;

double still_px(double picture_px) {
  return std::max(1.5, kStillShare * picture_px);
}

// A solution that the views do not determine is worse than a usual camera.
bool plausible(const Solution& solution, double picture_px) {
  const double focal = solution.intrinsics[0];
  return focal > 0.2 * picture_px && focal < 8.0 * picture_px && solution.sigma_of(0) < 0.1 * focal &&
         solution.rms_px < 0.01 * picture_px;
}

}  // namespace

const char* to_string(FrameUse use) {
  switch (use) {
    case FrameUse::NoBoard:
      return "the board is not seen";
    case FrameUse::Moving:
      return "hold it still";
    case FrameUse::Blurred:
      return "blurred: nearer to the focus, or more light";
    case FrameUse::Known:
      return "like a view that was taken";
    case FrameUse::Taken:
      return "taken";
  }
  return "";
}

ViewCollector::ViewCollector(const Board& board, int width, int height, std::size_t most)
    : board_(board), picture_px_(std::max(width, height)), most_(most), planner_(board, width, height) {
  coverage_.grid = make_grid(width, height, kCellsAcross);
  look_ahead();
}

FrameUse ViewCollector::add(const Observation& frame) {
  if (frame.points.size() < std::min(kFewestPoints, board_.points.size())) {
    still_frames_ = 0;
    return FrameUse::NoBoard;
  }
  if (still_frames_ == 0 || median_shift_px(anchor_, frame) > still_px(picture_px_)) {
    if (still_frames_ > 0) refused_.reset();
    anchor_ = frame;
    still_frames_ = 0;
  }
  ++still_frames_;
  if (still_frames_ < kStillFrames || frame.time_s - anchor_.time_s < kStillS) return FrameUse::Moving;
  sharpest_px_ = std::min(sharpest_px_, frame.edge_width_px);
  if (frame.edge_width_px > std::max(kSharpPx, kBlurRatio * sharpest_px_)) return FrameUse::Blurred;
  if (!adds_something(frame)) return FrameUse::Known;
  take(frame);
  return FrameUse::Taken;
}

bool ViewCollector::adds_something(const Observation& frame) const {
  const ViewDescriptor descriptor = descriptor_of(board_, frame, picture_px_);
  const auto unlike = [&](const Observation& other) {
    return distance(descriptor, descriptor_of(board_, other, picture_px_)) >= kNew;
  };
  return (!refused_ || unlike(*refused_)) && std::all_of(taken_.begin(), taken_.end(), unlike);
}

void ViewCollector::take(const Observation& frame) {
  taken_.push_back(frame);
  learn_camera();
  look_ahead();
}

void ViewCollector::drop_last() {
  if (taken_.empty()) return;
  refused_ = taken_.back();
  taken_.pop_back();
  look_ahead();
}

// The lens of the moment, good enough to tell tilts and distances by.
void ViewCollector::learn_camera() {
  if (taken_.size() < kViewsForCamera) return;
  const Grid& grid = coverage_.grid;
  SolveOptions options;
  options.lens = LensChoice::PlumbBob4;
  const auto solution = solve(board_, {grid.width, grid.height, taken_}, options);
  if (solution && plausible(*solution, picture_px_)) planner_.set_camera(solution->camera);
}

void ViewCollector::look_ahead() {
  const Grid& grid = coverage_.grid;
  coverage_.corners.assign(grid.size(), 0);
  coverage_.tilts.fill(0);
  coverage_.reaches.fill(0);
  for (const Observation& view : taken_) {
    for (const cv::Point2d& px : view.px) ++coverage_.corners[grid.cell_of(px)];
    const auto held = held_view_of(board_, view, planner_.camera());
    if (!held) continue;
    last_held_ = *held;
    ++coverage_.tilts.at(static_cast<std::size_t>(held->tilt));
    ++coverage_.reaches.at(static_cast<std::size_t>(held->reach));
  }
  const auto filled = std::count_if(coverage_.corners.begin(), coverage_.corners.end(), [](int n) { return n > 0; });
  coverage_.picture = static_cast<double>(filled) / static_cast<double>(grid.size());
  planner_.set_taken(taken_);
  next_ = planner_.best(grid, coverage_.corners);
  next_px_ = planner_.points_px(next_).value_or(std::vector<cv::Point2d>());
  expected_sigma_px_ = planner_.expected_sigma_px(kExpectedNoisePx);
}

bool ViewCollector::enough() const {
  if (taken_.size() >= most_) return true;
  const auto& tilts = coverage_.tilts;
  const bool all_ways = std::all_of(tilts.begin() + 1, tilts.end(), [](int views) { return views > 0; });
  const auto distances = std::count_if(coverage_.reaches.begin(), coverage_.reaches.end(), [](int n) { return n > 0; });
  return taken_.size() >= kGoodSet && coverage_.picture >= kWellCovered && all_ways && distances >= 2;
}

}  // namespace calib
