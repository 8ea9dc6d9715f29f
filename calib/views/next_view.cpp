#include "calib/views/next_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ar/track/lens.h"
#include "calib/solve/information.h"
#include "calib/solve/initialization.h"
#include "calib/solve/projection.h"

namespace calib {
namespace {

constexpr int kViewCellsAcross = 8;
constexpr double kUsualFocal = 0.9;  // of the longer side: 58 degrees across
constexpr double kNoisePx = 0.2;     // of a corner's coordinate
constexpr double kAskedTiltRad = 0.6;
constexpr double kFacingRad = 0.2;  // leaning less than that is facing
constexpr double kMarginShare = 0.02;
constexpr double kNewGround = 2.0;  // what the whole picture newly covered is worth, in logarithms of the variance
constexpr double kNewManner = 0.4;  // what a tilt or a distance is worth that no view has yet
constexpr std::array kTilts{Tilt::Facing, Tilt::LeftNearer, Tilt::RightNearer, Tilt::TopNearer, Tilt::BottomNearer};
constexpr std::array kReaches{Reach::Near, Reach::Middle, Reach::Far};

// The board's diagonal over the picture's longer side.
double share_of(Reach reach) {
  return reach == Reach::Near ? 0.75 : reach == Reach::Middle ? 0.5 : 0.33;
}

Reach reach_of(double share) {
  return share >= 0.62 ? Reach::Near : share >= 0.42 ? Reach::Middle : Reach::Far;
}

// An edge nearer turns the board's normal, which points away from its face, to that side.
cv::Vec3d lean_of(Tilt tilt) {
  switch (tilt) {
    case Tilt::LeftNearer:
      return {0.0, -kAskedTiltRad, 0.0};
    case Tilt::RightNearer:
      return {0.0, kAskedTiltRad, 0.0};
    case Tilt::TopNearer:
      return {kAskedTiltRad, 0.0, 0.0};
    case Tilt::BottomNearer:
      return {-kAskedTiltRad, 0.0, 0.0};
    case Tilt::Facing:
      break;
  }
  return {0.0, 0.0, 0.0};
}

Tilt tilt_of(const cv::Vec3d& normal) {
  if (std::acos(std::min(1.0, std::abs(normal[2]))) < kFacingRad) return Tilt::Facing;
  const double sign = normal[2] < 0.0 ? -1.0 : 1.0;
  if (std::abs(normal[0]) >= std::abs(normal[1])) return sign * normal[0] > 0.0 ? Tilt::RightNearer : Tilt::LeftNearer;
  return sign * normal[1] > 0.0 ? Tilt::BottomNearer : Tilt::TopNearer;
}

cv::Rect2d bounds_of(const std::vector<cv::Point2d>& px) {
  cv::Point2d low = px.front();
  cv::Point2d high = px.front();
  for (const cv::Point2d& p : px) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return {low, high};
}

// Which third of the room that the board leaves it has on the near side.
int third(double before, double after, double side) {
  const double room = before + after;
  if (room < 0.12 * side) return 1;
  return before < room / 3.0 ? 0 : before > 2.0 * room / 3.0 ? 2 : 1;
}

// What is known of any camera: a prior standard deviation for each number.
cv::Mat_<double> usual_information(const LensNumbers& numbers, int width, int height) {
  const double side = std::max(width, height);
  cv::Mat_<double> information(static_cast<int>(numbers.intrinsics.size()), static_cast<int>(numbers.intrinsics.size()),
                               0.0);
  const auto names = intrinsics_names(numbers.lens);
  for (int i = 0; i < information.rows; ++i) {
    const std::string& name = names[static_cast<std::size_t>(i)];
    const double sigma = name[0] == 'f' ? 0.3 * side : name[0] == 'c' ? 0.05 * side : name[0] == 'k' ? 0.3 : 0.01;
    information(i, i) = 1.0 / (sigma * sigma);
  }
  return information;
}

std::vector<cv::Vec3d> points_of(const Board& board, const Observation& view) {
  std::vector<cv::Vec3d> points;
  for (int p : view.points) points.push_back(board.points[static_cast<std::size_t>(p)]);
  return points;
}

}  // namespace

std::string words_of_place(const HeldView& view) {
  static constexpr const char* kPlaces[3][3] = {
      {"in the upper left corner", "at the top", "in the upper right corner"},
      {"at the left", "in the middle", "at the right"},
      {"in the lower left corner", "at the bottom", "in the lower right corner"}};
  return kPlaces[view.row][view.column];
}

std::string words_of_attitude(const HeldView& view) {
  static constexpr const char* kTiltWords[] = {"facing the camera", "tilted about the vertical axis (left edge nearer)",
                                               "tilted about the vertical axis (right edge nearer)",
                                               "tilted about the horizontal axis (top edge nearer)",
                                               "tilted about the horizontal axis (bottom edge nearer)"};
  static constexpr const char* kReachWords[] = {"near", "at a middle distance", "far"};
  return fmt::format("{}, {}", kTiltWords[static_cast<int>(view.tilt)], kReachWords[static_cast<int>(view.reach)]);
}

std::string words_of(const HeldView& view) {
  return words_of_place(view) + ", " + words_of_attitude(view);
}

std::optional<HeldView> held_view_of(const Board& board, const Observation& view, const ar::CameraModel& camera) {
  const auto pose = best_pose_of(board, view, ar::Lens(camera));
  if (!pose) return std::nullopt;
  const cv::Rect2d bounds = bounds_of(view.px);
  HeldView held;
  held.column = third(bounds.x, camera.width - bounds.br().x, camera.width);
  held.row = third(bounds.y, camera.height - bounds.br().y, camera.height);
  held.tilt = tilt_of(pose->rotation * cv::Vec3d(0.0, 0.0, 1.0));
  const double distance = cv::norm(*pose * middle_of(board));
  held.reach =
      reach_of(board.diagonal_m() * camera.intrinsics(0, 0) / (distance * std::max(camera.width, camera.height)));
  return held;
}

struct NextView::Candidate {
  PoseNumbers pose;
  std::vector<cv::Point2d> px;
};

NextView::NextView(const Board& board, int width, int height)
    : board_(board), grid_(make_grid(width, height, kViewCellsAcross)) {
  const double focal = kUsualFocal * std::max(width, height);
  set_camera(camera_of(LensChoice::PlumbBob4, {focal, focal, 0.5 * (width - 1), 0.5 * (height - 1), 0.0, 0.0, 0.0, 0.0},
                       width, height));
}

void NextView::set_camera(const ar::CameraModel& camera) {
  camera_ = camera;
  numbers_ = {lens_choice_of(camera), {}};
  numbers_.intrinsics = intrinsics_of(numbers_.lens, camera);
  moments_ = direction_moments(numbers_, grid_);
  set_taken({});
}

void NextView::set_taken(const std::vector<Observation>& taken) {
  information_ = usual_information(numbers_, grid_.width, grid_.height);
  taken_.clear();
  const ar::Lens lens(camera_);
  for (const Observation& view : taken) {
    const auto pose = best_pose_of(board_, view, lens);
    const auto held = held_view_of(board_, view, camera_);
    if (!pose || !held) continue;
    taken_.push_back(*held);
    cv::scaleAdd(view_information(numbers_.lens, numbers_.intrinsics, numbers_of(*pose), points_of(board_, view)),
                 1.0 / (kNoisePx * kNoisePx), information_, information_);
  }
}

double NextView::mean_variance(const cv::Mat_<double>& information) const {
  // Scaled to unit diagonal: the numbers' units are far apart.
  cv::Mat_<double> scale;
  cv::sqrt(information.diag(), scale);
  const cv::Mat_<double> units = cv::Mat(scale * scale.t());
  cv::Mat_<double> scaled;
  cv::divide(information, units, scaled);
  cv::Mat_<double> inverse;
  cv::invert(scaled, inverse, cv::DECOMP_CHOLESKY);
  cv::divide(inverse, units, inverse);
  return moments_.dot(inverse);  // both are symmetric: the trace of their product
}

double NextView::expected_sigma_px(double noise_px) const {
  return std::sqrt(mean_variance(information_)) * noise_px / kNoisePx;
}

// The board so that its picture touches the asked border, as far away as asked or as far as it takes to fit.
std::optional<NextView::Candidate> NextView::posed(const HeldView& view) const {
  const ar::Lens lens(camera_);
  const double side = std::max(grid_.width, grid_.height);
  const double margin = kMarginShare * side;
  const cv::Matx33d rotation = ar::rotation_from_vector(lean_of(view.tilt));
  const cv::Vec3d middle = rotation * middle_of(board_);
  const double focal = camera_.intrinsics(0, 0);
  const double distance = board_.diagonal_m() * focal / (share_of(view.reach) * side);
  cv::Vec3d at(0.0, 0.0, distance);
  Candidate candidate;
  for (int round = 0; round < 12; ++round) {
    candidate.pose = numbers_of({rotation, at - middle});
    candidate.px.clear();
    for (const cv::Vec3d& p : board_.points) {
      const auto px = lens.project(rotation * p + at - middle);
      if (!px) return std::nullopt;
      candidate.px.push_back(*px);
    }
    const cv::Rect2d box = bounds_of(candidate.px);
    const double fits = std::min((grid_.width - 2.0 * margin) / box.width, (grid_.height - 2.0 * margin) / box.height);
    if (fits < 1.0) at *= 1.02 / fits;
    const cv::Point2d room(grid_.width - 2.0 * margin - box.width, grid_.height - 2.0 * margin - box.height);
    const cv::Point2d shift(margin + 0.5 * view.column * room.x - box.x, margin + 0.5 * view.row * room.y - box.y);
    if (fits >= 1.0 && cv::norm(shift) < 0.01 * side) return candidate;
    at += cv::Vec3d(shift.x, shift.y, 0.0) * (at[2] / focal);
  }
  return std::nullopt;
}

double NextView::shrinks_to(const Candidate& candidate) const {
  cv::Mat_<double> with;
  cv::scaleAdd(view_information(numbers_.lens, numbers_.intrinsics, candidate.pose, board_.points),
               1.0 / (kNoisePx * kNoisePx), information_, with);
  return std::sqrt(mean_variance(with) / mean_variance(information_));
}

std::optional<double> NextView::shrinks_to(const HeldView& view) const {
  const auto candidate = posed(view);
  if (!candidate) return std::nullopt;
  return shrinks_to(*candidate);
}

std::optional<std::vector<cv::Point2d>> NextView::points_px(const HeldView& view) const {
  auto candidate = posed(view);
  if (!candidate) return std::nullopt;
  return std::move(candidate->px);
}

// How many of tilt and distance no view has that was taken.
int NextView::new_manners(const HeldView& view) const {
  const bool tilt = std::none_of(taken_.begin(), taken_.end(), [&](const HeldView& t) { return t.tilt == view.tilt; });
  const bool reach =
      std::none_of(taken_.begin(), taken_.end(), [&](const HeldView& t) { return t.reach == view.reach; });
  return (tilt ? 1 : 0) + (reach ? 1 : 0);
}

HeldView NextView::best(const Grid& grid, const std::vector<int>& corners) const {
  HeldView best;
  double best_value = -std::numeric_limits<double>::infinity();
  for (int place = 0; place < 9; ++place) {
    for (Tilt tilt : kTilts) {
      for (Reach reach : kReaches) {
        const HeldView view{place % 3, place / 3, tilt, reach};
        if (std::find(taken_.begin(), taken_.end(), view) != taken_.end()) continue;
        const auto candidate = posed(view);
        if (!candidate) continue;
        std::vector<bool> fresh(grid.size(), false);
        for (const cv::Point2d& px : candidate->px) fresh[grid.cell_of(px)] = corners[grid.cell_of(px)] == 0;
        const auto cells = static_cast<double>(std::count(fresh.begin(), fresh.end(), true));
        const double value = -2.0 * std::log(shrinks_to(*candidate)) +
                             kNewGround * cells / static_cast<double>(grid.size()) + kNewManner * new_manners(view);
        if (value <= best_value) continue;
        best_value = value;
        best = view;
      }
    }
  }
  return best;
}

}  // namespace calib
