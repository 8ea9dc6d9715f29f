#include "calib/verdict/quality_gates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/solve/cross_validation.h"
#include "calib/verdict/diagnostics.h"
#include "render/base/median.h"

namespace calib {
namespace {

constexpr int kCellsAcross = 16;

ViewGeometry geometry_of(const Board& board, const ViewFit& fit) {
  ViewGeometry out;
  out.used = fit.any_used();
  const cv::Vec3d normal = fit.camera_from_board.rotation * cv::Vec3d(0.0, 0.0, 1.0);
  out.tilt_rad = std::acos(std::min(1.0, std::abs(normal[2])));
  out.direction_rad = std::atan2(normal[1], normal[0]);
  out.distance_m = cv::norm(fit.camera_from_board * middle_of(board));
  return out;
}

double normals_spread(const Solution& solution, const std::vector<std::size_t>& used) {
  double spread = 0.0;
  for (std::size_t a : used) {
    for (std::size_t b : used) {
      const cv::Vec3d one = solution.views[a].camera_from_board.rotation * cv::Vec3d(0.0, 0.0, 1.0);
      const cv::Vec3d two = solution.views[b].camera_from_board.rotation * cv::Vec3d(0.0, 0.0, 1.0);
      spread = std::max(spread, std::acos(std::clamp(one.dot(two), -1.0, 1.0)));
    }
  }
  return spread;
}

void summarise_sigma(Assessment& j) {
  std::vector<double> where_seen;
  for (std::size_t i = 0; i < j.sigma_px.size(); ++i) {
    if (j.corners[i] > 0 && !std::isnan(j.sigma_px[i])) where_seen.push_back(j.sigma_px[i]);
    if (!std::isnan(j.sigma_px[i])) j.sigma_worst_px = std::max(j.sigma_worst_px, j.sigma_px[i]);
  }
  j.sigma_typical_px = render::upper_median(where_seen);
}

double coverage_of(const std::vector<int>& corners) {
  const auto filled = std::count_if(corners.begin(), corners.end(), [](int n) { return n > 0; });
  return static_cast<double>(filled) / static_cast<double>(corners.size());
}

}  // namespace

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::Good:
      return "good";
    case Verdict::Usable:
      return "usable";
    case Verdict::Rejected:
      return "rejected";
  }
  return "";
}

std::string Assessment::sentence(const Solution& solution) const {
  const std::string numbers = fmt::format(
      "RMS {:.3f} px, held out {:.3f} px; focal length {:.1f} +- {:.1f} px; a direction is seen to "
      "{:.2f} px; {} views, {:.0f} % of the picture covered",
      solution.rms_px, held_out_rms_px, solution.intrinsics[0], solution.sigma_of(0), sigma_typical_px,
      solution.used_views().size(), 100.0 * covered);
  if (diagnostics.empty()) return fmt::format("good: {}", numbers);
  return fmt::format("{}: {} ({})", to_string(verdict), diagnostics.front().what, numbers);
}

Assessment assess(const Board& board, const Observations& observations, const Solution& solution,
                  const SolveOptions& options) {
  Assessment j;
  j.held_out_rms_px = held_out_rms_px(board, observations, solution, options, &j.folds);
  j.grid = make_grid(observations.width, observations.height, kCellsAcross);
  j.corners = corners_in_cells(observations, solution, j.grid);
  j.covered = coverage_of(j.corners);
  j.sigma_px = projected_sigma_px(solution, j.grid, j.corners);
  summarise_sigma(j);
  std::vector<double> edges;
  for (const Observation& view : observations.views) {
    if (view.edge_width_px > 0.0) edges.push_back(view.edge_width_px);
  }
  j.edge_width_px = edges.empty() ? 0.0 : render::upper_median(edges);
  for (const ViewFit& fit : solution.views) {
    j.views.push_back(geometry_of(board, fit));
    if (j.views.back().used) j.largest_tilt_rad = std::max(j.largest_tilt_rad, j.views.back().tilt_rad);
  }
  j.normals_spread_rad = normals_spread(solution, solution.used_views());
  j.diagnostics = diagnostics_of(board, solution, j);
  j.verdict = j.diagnostics.empty()           ? Verdict::Good
              : j.diagnostics.front().rejects ? Verdict::Rejected
                                              : Verdict::Usable;
  return j;
}

}  // namespace calib
