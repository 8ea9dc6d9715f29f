#include "calib/view_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>

namespace calib {
namespace {

constexpr double kAlike = 0.04;          // views nearer than that to a chosen one tell nothing new
constexpr double kSlowestCommon = 0.25;  // share of the frames that are still enough at least

// What a view looks like: place, size and tilt, so scaled that 1 is about as different as views get.
using Looks = std::array<double, 5>;

double distance(const Looks& a, const Looks& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::infinity();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double median_shift(const Sighting& a, const Sighting& b) {
  std::vector<double> shifts;
  for (std::size_t i = 0, k = 0; i < a.points.size() && k < b.points.size();) {
    if (a.points[i] == b.points[k]) {
      shifts.push_back(cv::norm(a.px[i++] - b.px[k++]));
    } else {
      (a.points[i] < b.points[k] ? i : k) += 1;
    }
  }
  return median(shifts);
}

double speed_between(const Sighting& a, const Sighting& b) {
  const double time = std::abs(b.time_s - a.time_s);
  return time > 0.0 ? median_shift(a, b) / time : std::numeric_limits<double>::infinity();
}

Looks looks_of(const Board& board, const Sighting& view, double picture_px) {
  cv::Point2d mean;
  for (const cv::Point2d& p : view.px) mean += p / static_cast<double>(view.px.size());
  Looks looks{mean.x / picture_px, mean.y / picture_px, 0.0, 0.0, 0.0};
  std::vector<cv::Point2d> on_board;
  for (int p : view.points) {
    const cv::Vec3d& at = board.points[static_cast<std::size_t>(p)];
    on_board.emplace_back(at[0] / board.diagonal_m(), at[1] / board.diagonal_m());
  }
  const cv::Mat homography = cv::findHomography(on_board, view.px);
  if (homography.empty()) return looks;
  const cv::Matx33d h(homography);
  // The perspective terms say how the board leans; its size is how far away it is.
  const double size = std::sqrt(std::abs(cv::determinant(h.get_minor<2, 2>(0, 0)))) / picture_px;
  looks[2] = 0.5 * std::log2(std::max(1e-3, size));
  looks[3] = 2.0 * h(2, 0);
  looks[4] = 2.0 * h(2, 1);
  return looks;
}

// A blurred or moving view must differ by more to be chosen.
double quality(const Sighting& view, double speed, double sharpest, double picture_px) {
  const double blur = std::max(1.0, view.edge_width_px / sharpest);
  const double moves = std::isfinite(speed) ? speed / (0.1 * picture_px) : 1.0;
  return 1.0 / (blur * blur * (1.0 + moves));
}

}  // namespace

std::vector<double> speeds_px_s(const std::vector<Sighting>& frames) {
  std::vector<double> speeds;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    double speed = std::numeric_limits<double>::infinity();
    if (i > 0) speed = std::min(speed, speed_between(frames[i - 1], frames[i]));
    if (i + 1 < frames.size()) speed = std::min(speed, speed_between(frames[i], frames[i + 1]));
    speeds.push_back(speed);
  }
  return speeds;
}

std::vector<std::size_t> choose_views(const Board& board, const std::vector<Sighting>& frames, int width, int height,
                                      std::size_t most) {
  const double picture_px = std::max(width, height);
  std::size_t fullest = 0;
  double sharpest = std::numeric_limits<double>::infinity();
  for (const Sighting& f : frames) {
    fullest = std::max(fullest, f.points.size());
    if (!f.points.empty()) sharpest = std::min(sharpest, f.edge_width_px);
  }
  const std::vector<double> speeds = speeds_px_s(frames);
  std::vector<double> sorted = speeds;
  std::sort(sorted.begin(), sorted.end());
  // A tenth of the picture in a second is still enough; where nothing is that still, the stillest quarter is.
  const double fast =
      frames.empty()
          ? 0.0
          : std::max(0.1 * picture_px,
                     sorted[static_cast<std::size_t>(kSlowestCommon * static_cast<double>(sorted.size() - 1))]);
  struct Candidate {
    std::size_t index;
    Looks looks;
    double quality;
    double nearest = 1.0;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].points.size() < 4 || 3 * frames[i].points.size() < fullest || speeds[i] > fast) continue;
    candidates.push_back(
        {i, looks_of(board, frames[i], picture_px), quality(frames[i], speeds[i], sharpest, picture_px)});
  }
  std::vector<std::size_t> chosen;
  while (chosen.size() < most && !candidates.empty()) {
    const auto gain = [](const Candidate& c) { return c.nearest * c.quality; };
    const auto best = std::max_element(candidates.begin(), candidates.end(),
                                       [&](const Candidate& a, const Candidate& b) { return gain(a) < gain(b); });
    if (best->nearest < kAlike) break;
    const Looks looks = best->looks;
    chosen.push_back(best->index);
    candidates.erase(best);
    for (Candidate& c : candidates) c.nearest = std::min(c.nearest, distance(c.looks, looks));
    std::erase_if(candidates, [](const Candidate& c) { return c.nearest < kAlike; });
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace calib
