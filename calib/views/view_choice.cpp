#include "calib/views/view_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/views/view_descriptor.h"

namespace calib {
namespace {

constexpr double kAlike = 0.04;          // views nearer than that to a chosen one tell nothing new
constexpr double kSlowestCommon = 0.25;  // share of the frames that are still enough at least

double speed_between(const Observation& a, const Observation& b) {
  const double time = std::abs(b.time_s - a.time_s);
  return time > 0.0 ? median_shift_px(a, b) / time : std::numeric_limits<double>::infinity();
}

// A blurred or moving view must differ by more to be chosen.
double quality(const Observation& view, double speed, double sharpest, double picture_px) {
  const double blur = std::max(1.0, view.edge_width_px / sharpest);
  const double moves = std::isfinite(speed) ? speed / (0.1 * picture_px) : 1.0;
  return 1.0 / (blur * blur * (1.0 + moves));
}

}  // namespace

std::vector<double> speeds_px_s(const std::vector<Observation>& frames) {
  std::vector<double> speeds;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    double speed = std::numeric_limits<double>::infinity();
    if (i > 0) speed = std::min(speed, speed_between(frames[i - 1], frames[i]));
    if (i + 1 < frames.size()) speed = std::min(speed, speed_between(frames[i], frames[i + 1]));
    speeds.push_back(speed);
  }
  return speeds;
}

std::vector<std::size_t> choose_views(const Board& board, const std::vector<Observation>& frames, int width, int height,
                                      std::size_t most) {
  const double picture_px = std::max(width, height);
  std::size_t fullest = 0;
  double sharpest = std::numeric_limits<double>::infinity();
  for (const Observation& f : frames) {
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
    ViewDescriptor descriptor;
    double quality;
    double nearest = 1.0;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].points.size() < 4 || 3 * frames[i].points.size() < fullest || speeds[i] > fast) continue;
    candidates.push_back(
        {i, descriptor_of(board, frames[i], picture_px), quality(frames[i], speeds[i], sharpest, picture_px)});
  }
  std::vector<std::size_t> chosen;
  while (chosen.size() < most && !candidates.empty()) {
    const auto gain = [](const Candidate& c) { return c.nearest * c.quality; };
    const auto best = std::max_element(candidates.begin(), candidates.end(),
                                       [&](const Candidate& a, const Candidate& b) { return gain(a) < gain(b); });
    if (best->nearest < kAlike) break;
    const ViewDescriptor descriptor = best->descriptor;
    chosen.push_back(best->index);
    candidates.erase(best);
    for (Candidate& c : candidates) c.nearest = std::min(c.nearest, distance(c.descriptor, descriptor));
    std::erase_if(candidates, [](const Candidate& c) { return c.nearest < kAlike; });
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace calib
