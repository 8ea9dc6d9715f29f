#include "calib/verdict/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace calib {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

// Gates. A calibration that fails one of the first kind is rejected; the second kind is reported.
constexpr int kFewestViews = 4;
constexpr int kEnoughViews = 8;
constexpr double kFlattestTiltDeg = 10.0;  // below, the board's perspective is lost in the corners' noise
constexpr double kSmallestSpreadDeg = 10.0;
constexpr double kWeakFocal = 0.01;  // sigma over focal length
constexpr double kUnsureFocal = 0.003;
constexpr double kWorstRms = 1.0 / 1500.0;    // of the longer side; at least 1 px
constexpr double kPoorRms = 1.0 / 3000.0;     // at least 0.5 px
constexpr double kOverfit = 1.5;              // held-out over fitted RMS
constexpr double kWorstSigma = 1.0 / 1000.0;  // projected, typical, of the longer side; at least 1 px
constexpr double kPoorSigma = 1.0 / 4000.0;   // at least 0.25 px
constexpr double kLeastCovered = 0.25;
constexpr double kWellCovered = 0.6;
constexpr double kBlurredPx = 6.0;     // width of an edge; sharp pictures have 2 to 3
constexpr double kMostRejected = 0.2;  // share of corners

// In words, where the largest part of the picture without corners lies.
std::string emptiest_part(const Assessment& j) {
  const char* const names[3][3] = {{"upper left", "upper middle", "upper right"},
                                   {"left", "middle", "right"},
                                   {"lower left", "lower middle", "lower right"}};
  double emptiest = 2.0;
  std::string found;
  for (int part = 0; part < 9; ++part) {
    int cells = 0;
    int filled = 0;
    for (std::size_t i = 0; i < j.grid.size(); ++i) {
      const cv::Point2d px = j.grid.middle(i);
      const int column = static_cast<int>(3.0 * px.x / j.grid.width);
      const int row = static_cast<int>(3.0 * px.y / j.grid.height);
      if (row * 3 + column != part) continue;
      ++cells;
      filled += j.corners[i] > 0 ? 1 : 0;
    }
    const double share = cells > 0 ? static_cast<double>(filled) / cells : 2.0;
    if (share >= emptiest) continue;
    emptiest = share;
    found = names[part / 3][part % 3];
  }
  return found;
}

class Diagnostics {
 public:
  explicit Diagnostics(std::vector<Diagnostic>& out) : out_(out) {}
  void reject(bool when, std::string what, std::string to_do) { add(when, true, std::move(what), std::move(to_do)); }
  void tell(bool when, std::string what, std::string to_do) { add(when, false, std::move(what), std::move(to_do)); }

 private:
  void add(bool when, bool rejects, std::string what, std::string to_do) {
    if (when) out_.push_back({rejects, std::move(what), std::move(to_do)});
  }
  std::vector<Diagnostic>& out_;
};

double focal_uncertainty(const Solution& solution) {
  const double sigma =
      std::max(solution.sigma_of(0) / solution.intrinsics[0], solution.sigma_of(1) / solution.intrinsics[1]);
  return std::isfinite(sigma) ? sigma : std::numeric_limits<double>::infinity();
}

// What the set of views cannot tell, whatever its residuals.
void find_degeneracies(const Board& board, const Solution& solution, const Assessment& j, Diagnostics& diagnostics) {
  const int views = static_cast<int>(solution.used_views().size());
  diagnostics.reject(views == 1, "one view only: its pose and the focal length cannot be told apart",
                     "add views of the board from other sides, tilted by 20 to 45 degrees; ten are a good set");
  diagnostics.reject(views > 1 && views < kFewestViews, fmt::format("{} views only", views),
                     "add views of the board from other sides, tilted by 20 to 45 degrees; ten are a good set");
  if (views < 2) return;
  const bool flat = board.is_flat();
  const bool head_on = flat && j.largest_tilt_rad * kDegrees < kFlattestTiltDeg;
  diagnostics.reject(
      head_on,
      fmt::format("all views are head-on (the board is tilted by {:.1f} degrees at most), which cannot give "
                  "a focal length: a nearer board and a longer lens look the same",
                  j.largest_tilt_rad * kDegrees),
      "add views with the board tilted by 20 to 45 degrees, to the left, right, up and down");
  diagnostics.reject(flat && !head_on && j.normals_spread_rad * kDegrees < kSmallestSpreadDeg,
                     fmt::format("all views see the board from one side (its normals differ by {:.1f} degrees at most)",
                                 j.normals_spread_rad * kDegrees),
                     "add views with the board tilted the other ways");
  const double focal = focal_uncertainty(solution);
  diagnostics.reject(!head_on && focal > kWeakFocal,
                     std::isfinite(focal) ? fmt::format("the focal length is known to {:.1f} % only", 100.0 * focal)
                                          : "the views do not determine the camera",
                     "add nearer views with the board tilted by 20 to 45 degrees, different ways");
  diagnostics.tell(focal <= kWeakFocal && focal > kUnsureFocal,
                   fmt::format("the focal length is known to {:.2f} %", 100.0 * focal),
                   "add nearer views with the board tilted by 20 to 45 degrees");
  diagnostics.tell(views >= kFewestViews && views < kEnoughViews, fmt::format("{} views are few", views),
                   "ten views from different sides are a good set");
}

void find_poor_fit(const Solution& solution, const Assessment& j, Diagnostics& diagnostics) {
  const double side = std::max(j.grid.width, j.grid.height);
  const double worst = std::max(1.0, kWorstRms * side);
  const double poor = std::max(0.5, kPoorRms * side);
  const std::string rms = fmt::format("corners are off by {:.2f} px RMS", solution.rms_px);
  diagnostics.reject(solution.rms_px > worst, rms,
                     "check the board file against the board, and that the board is flat and the pictures are sharp");
  diagnostics.tell(solution.rms_px <= worst && solution.rms_px > poor, rms,
                   "hold the board flatter and stiller; or let --solve flatness,layout find its errors");
  const int corners = solution.points_used + solution.points_rejected;
  diagnostics.reject(solution.points_rejected > kMostRejected * corners,
                     fmt::format("{} of {} corners do not fit the rest", solution.points_rejected, corners),
                     "check the board file against the board, and the views named as outliers");
  diagnostics.reject(j.held_out_rms_px > kOverfit * solution.rms_px + 0.05,
                     fmt::format("views that were held out are off by {:.2f} px RMS, those that were fitted by {:.2f}",
                                 j.held_out_rms_px, solution.rms_px),
                     "add views, or take a simpler --lens");
  diagnostics.reject(j.edge_width_px > kBlurredPx,
                     fmt::format("the pictures are blurred: edges take {:.1f} px, sharp ones 2 to 3", j.edge_width_px),
                     "focus, hold still, give more light");
}

void find_gaps(const Assessment& j, Diagnostics& diagnostics) {
  const double side = std::max(j.grid.width, j.grid.height);
  const double worst = std::max(1.0, kWorstSigma * side);
  const double poor = std::max(0.25, kPoorSigma * side);
  diagnostics.reject(j.covered < kLeastCovered,
                     fmt::format("corners cover {:.0f} % of the picture only", 100.0 * j.covered),
                     fmt::format("add views with the board in the {} of the picture", emptiest_part(j)));
  diagnostics.reject(!(j.sigma_typical_px <= worst),
                     fmt::format("where the camera sees a direction is known to {:.2f} px only", j.sigma_typical_px),
                     "add views");
  diagnostics.tell(j.sigma_typical_px <= worst && j.sigma_typical_px > poor,
                   fmt::format("where the camera sees a direction is known to {:.2f} px", j.sigma_typical_px),
                   "add views, nearer and tilted");
  diagnostics.tell(j.covered >= kLeastCovered && j.covered < kWellCovered,
                   fmt::format("corners cover {:.0f} % of the picture; beyond, the lens is a guess", 100.0 * j.covered),
                   fmt::format("add views with the board in the {} of the picture", emptiest_part(j)));
}

}  // namespace

std::vector<Diagnostic> diagnostics_of(const Board& board, const Solution& solution, const Assessment& assessment) {
  std::vector<Diagnostic> all;
  Diagnostics diagnostics(all);
  find_degeneracies(board, solution, assessment, diagnostics);
  find_poor_fit(solution, assessment, diagnostics);
  find_gaps(assessment, diagnostics);
  std::stable_partition(all.begin(), all.end(), [](const Diagnostic& f) { return f.rejects; });
  return all;
}

}  // namespace calib
