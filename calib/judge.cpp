#include "calib/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace calib {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr int kCellsAcross = 16;

// Gates. A calibration that fails one of the first kind is rejected; the second kind is told.
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

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<std::size_t> used_views(const Solution& solution) {
  std::vector<std::size_t> used;
  for (std::size_t v = 0; v < solution.views.size(); ++v) {
    if (solution.views[v].any_used()) used.push_back(v);
  }
  return used;
}

cv::Vec3d middle_of(const Board& board) {
  cv::Vec3d sum(0.0, 0.0, 0.0);
  for (const cv::Vec3d& p : board.points) sum += p;
  return sum / static_cast<double>(board.points.size());
}

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

// In words, where the largest part of the picture without corners lies.
std::string emptiest_part(const Judgement& j) {
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

class Findings {
 public:
  explicit Findings(std::vector<Finding>& out) : out_(out) {}
  void reject(bool when, std::string what, std::string to_do) { add(when, true, std::move(what), std::move(to_do)); }
  void tell(bool when, std::string what, std::string to_do) { add(when, false, std::move(what), std::move(to_do)); }

 private:
  void add(bool when, bool rejects, std::string what, std::string to_do) {
    if (when) out_.push_back({rejects, std::move(what), std::move(to_do)});
  }
  std::vector<Finding>& out_;
};

double focal_uncertainty(const Solution& solution) {
  const double sigma =
      std::max(solution.sigma_of(0) / solution.intrinsics[0], solution.sigma_of(1) / solution.intrinsics[1]);
  return std::isfinite(sigma) ? sigma : std::numeric_limits<double>::infinity();
}

// What the set of views cannot tell, whatever its residuals.
void find_degeneracies(const Board& board, const Solution& solution, const Judgement& j, Findings& findings) {
  const int views = static_cast<int>(used_views(solution).size());
  findings.reject(views == 1, "one view only: its pose and the focal length cannot be told apart",
                  "add views of the board from other sides, tilted by 20 to 45 degrees; ten are a good set");
  findings.reject(views > 1 && views < kFewestViews, fmt::format("{} views only", views),
                  "add views of the board from other sides, tilted by 20 to 45 degrees; ten are a good set");
  if (views < 2) return;
  const bool flat = board.is_flat();
  const bool head_on = flat && j.largest_tilt_rad * kDegrees < kFlattestTiltDeg;
  findings.reject(
      head_on,
      fmt::format("all views are head-on (the board is tilted by {:.1f} degrees at most), which cannot give "
                  "a focal length: a nearer board and a longer lens look the same",
                  j.largest_tilt_rad * kDegrees),
      "add views with the board tilted by 20 to 45 degrees, to the left, right, up and down");
  findings.reject(flat && !head_on && j.normals_spread_rad * kDegrees < kSmallestSpreadDeg,
                  fmt::format("all views see the board from one side (its normals differ by {:.1f} degrees at most)",
                              j.normals_spread_rad * kDegrees),
                  "add views with the board tilted the other ways");
  const double focal = focal_uncertainty(solution);
  findings.reject(!head_on && focal > kWeakFocal,
                  std::isfinite(focal) ? fmt::format("the focal length is known to {:.1f} % only", 100.0 * focal)
                                       : "the views do not determine the camera",
                  "add nearer views with the board tilted by 20 to 45 degrees, different ways");
  findings.tell(focal <= kWeakFocal && focal > kUnsureFocal,
                fmt::format("the focal length is known to {:.2f} %", 100.0 * focal),
                "add nearer views with the board tilted by 20 to 45 degrees");
  findings.tell(views >= kFewestViews && views < kEnoughViews, fmt::format("{} views are few", views),
                "ten views from different sides are a good set");
}

void find_poor_fit(const Solution& solution, const Judgement& j, Findings& findings) {
  const double side = std::max(j.grid.width, j.grid.height);
  const double worst = std::max(1.0, kWorstRms * side);
  const double poor = std::max(0.5, kPoorRms * side);
  const std::string rms = fmt::format("corners are off by {:.2f} px RMS", solution.rms_px);
  findings.reject(solution.rms_px > worst, rms,
                  "check the board file against the board, and that the board is flat and the pictures are sharp");
  findings.tell(solution.rms_px <= worst && solution.rms_px > poor, rms,
                "hold the board flatter and stiller; or let --solve flatness,layout find its errors");
  const int corners = solution.points_used + solution.points_rejected;
  findings.reject(solution.points_rejected > kMostRejected * corners,
                  fmt::format("{} of {} corners do not fit the rest", solution.points_rejected, corners),
                  "check the board file against the board, and the views named as outliers");
  findings.reject(j.held_out_rms_px > kOverfit * solution.rms_px + 0.05,
                  fmt::format("views that were held out are off by {:.2f} px RMS, those that were fitted by {:.2f}",
                              j.held_out_rms_px, solution.rms_px),
                  "add views, or take a simpler --lens");
  findings.reject(j.edge_width_px > kBlurredPx,
                  fmt::format("the pictures are blurred: edges take {:.1f} px, sharp ones 2 to 3", j.edge_width_px),
                  "focus, hold still, give more light");
}

void find_gaps(const Judgement& j, Findings& findings) {
  const double side = std::max(j.grid.width, j.grid.height);
  const double worst = std::max(1.0, kWorstSigma * side);
  const double poor = std::max(0.25, kPoorSigma * side);
  findings.reject(j.covered < kLeastCovered,
                  fmt::format("corners cover {:.0f} % of the picture only", 100.0 * j.covered),
                  fmt::format("add views with the board in the {} of the picture", emptiest_part(j)));
  findings.reject(!(j.sigma_typical_px <= worst),
                  fmt::format("where the camera sees a direction is known to {:.2f} px only", j.sigma_typical_px),
                  "add views");
  findings.tell(j.sigma_typical_px <= worst && j.sigma_typical_px > poor,
                fmt::format("where the camera sees a direction is known to {:.2f} px", j.sigma_typical_px),
                "add views, nearer and tilted");
  findings.tell(j.covered >= kLeastCovered && j.covered < kWellCovered,
                fmt::format("corners cover {:.0f} % of the picture; beyond, the lens is a guess", 100.0 * j.covered),
                fmt::format("add views with the board in the {} of the picture", emptiest_part(j)));
}

void summarise_sigma(Judgement& j) {
  std::vector<double> where_seen;
  for (std::size_t i = 0; i < j.sigma_px.size(); ++i) {
    if (j.corners[i] > 0 && !std::isnan(j.sigma_px[i])) where_seen.push_back(j.sigma_px[i]);
    if (!std::isnan(j.sigma_px[i])) j.sigma_worst_px = std::max(j.sigma_worst_px, j.sigma_px[i]);
  }
  j.sigma_typical_px = median(where_seen);
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

std::string Judgement::sentence(const Solution& solution) const {
  const std::string numbers = fmt::format(
      "RMS {:.3f} px, held out {:.3f} px; focal length {:.1f} +- {:.1f} px; a direction is seen to "
      "{:.2f} px; {} views, {:.0f} % of the picture covered",
      solution.rms_px, held_out_rms_px, solution.intrinsics[0], solution.sigma_of(0), sigma_typical_px,
      used_views(solution).size(), 100.0 * covered);
  if (findings.empty()) return fmt::format("good: {}", numbers);
  return fmt::format("{}: {} ({})", to_string(verdict), findings.front().what, numbers);
}

double held_out_rms_px(const Board& board, const Sightings& sightings, const Solution& solution,
                       const SolveOptions& options, int* folds) {
  const std::vector<std::size_t> used = used_views(solution);
  const int fold_count = static_cast<int>(used.size() < 10 ? used.size() : 5);
  if (folds != nullptr) *folds = fold_count;
  if (used.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0;
  int count = 0;
  for (int fold = 0; fold < fold_count; ++fold) {
    Sightings others = sightings;
    others.views.clear();
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (static_cast<int>(i) % fold_count != fold) others.views.push_back(sightings.views[used[i]]);
    }
    SolveOptions again = options;
    again.start = solution.camera;
    const auto trained = solve(board, others, again);
    if (!trained) return std::numeric_limits<double>::infinity();
    // A board whose errors were solved for is the board that the others showed.
    Board as_learnt = board;
    for (std::size_t p = 0; p < trained->board_error.size(); ++p) as_learnt.points[p] += trained->board_error[p];
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (static_cast<int>(i) % fold_count != fold) continue;
      const std::vector<bool>& corners = solution.views[used[i]].used;
      const auto fit = fit_view(as_learnt, sightings.views[used[i]], corners, trained->camera);
      if (!fit) return std::numeric_limits<double>::infinity();
      const auto n = static_cast<int>(std::count(corners.begin(), corners.end(), true));
      sum += fit->rms_px * fit->rms_px * n;
      count += n;
    }
  }
  return std::sqrt(sum / count);
}

Judgement judge(const Board& board, const Sightings& sightings, const Solution& solution, const SolveOptions& options) {
  Judgement j;
  j.held_out_rms_px = held_out_rms_px(board, sightings, solution, options, &j.folds);
  j.grid = make_grid(sightings.width, sightings.height, kCellsAcross);
  j.corners = corners_in_cells(sightings, solution, j.grid);
  j.covered = coverage_of(j.corners);
  j.sigma_px = projected_sigma_px(solution, j.grid, j.corners);
  summarise_sigma(j);
  std::vector<double> edges;
  for (const Sighting& view : sightings.views) {
    if (view.edge_width_px > 0.0) edges.push_back(view.edge_width_px);
  }
  j.edge_width_px = edges.empty() ? 0.0 : median(edges);
  for (const ViewFit& fit : solution.views) {
    j.views.push_back(geometry_of(board, fit));
    if (j.views.back().used) j.largest_tilt_rad = std::max(j.largest_tilt_rad, j.views.back().tilt_rad);
  }
  j.normals_spread_rad = normals_spread(solution, used_views(solution));
  Findings findings(j.findings);
  find_degeneracies(board, solution, j, findings);
  find_poor_fit(solution, j, findings);
  find_gaps(j, findings);
  std::stable_partition(j.findings.begin(), j.findings.end(), [](const Finding& f) { return f.rejects; });
  j.verdict = j.findings.empty() ? Verdict::Good : j.findings.front().rejects ? Verdict::Rejected : Verdict::Usable;
  return j;
}

std::optional<LensChoice> choose_lens(const Board& board, const Sightings& sightings, const SolveOptions& options,
                                      std::vector<LensTrial>* trials) {
  std::vector<LensTrial> all;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < lens_choice_names().size(); ++i) {
    SolveOptions attempt = options;
    attempt.lens = static_cast<LensChoice>(i);
    const auto solution = solve(board, sightings, attempt);
    LensTrial trial{attempt.lens, solution.has_value(), 0.0, std::numeric_limits<double>::infinity()};
    if (solution) {
      trial.rms_px = solution->rms_px;
      trial.held_out_rms_px = held_out_rms_px(board, sightings, *solution, attempt, nullptr);
      // Corners that a lens does not explain must not make it look better.
      const double all_points = solution->points_used + solution->points_rejected;
      trial.held_out_rms_px *= std::sqrt(all_points / std::max(1, solution->points_used));
    }
    if (trial.held_out_rms_px < best) best = trial.held_out_rms_px;
    all.push_back(trial);
  }
  if (trials != nullptr) *trials = all;
  for (const LensTrial& trial : all) {
    if (trial.solved && trial.held_out_rms_px <= 1.1 * best) return trial.lens;
  }
  for (const LensTrial& trial : all) {
    if (trial.solved && trial.lens == LensChoice::PlumbBob4) return trial.lens;
  }
  return std::nullopt;
}

}  // namespace calib
