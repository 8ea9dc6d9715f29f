#include "calib/solve/solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ar/track/corner_bias.h"
#include "ar/track/lens.h"
#include "calib/solve/bundle.h"
#include "calib/solve/information.h"
#include "calib/solve/initialization.h"
#include "calib/solve/projection.h"
#include "calib/solve/weak_direction.h"
#include "render/base/median.h"

namespace calib {
namespace {

constexpr std::size_t kFewestPoints = 4;  // of a view that has a pose
constexpr double kOutlierSigmas = 5.0;    // one honest corner in 270,000 is that far off
constexpr double kWeak = 1e-6;            // conditioning below which derivatives at the solution tell too little
constexpr double kQuietestPx = 0.02;      // corners that agree better than that are all believed

double squared(const cv::Point2d& p) {
  return p.dot(p);
}

Bundle make_bundle(const Board& board, const Observations& observations, const SolveOptions& options) {
  Bundle bundle;
  bundle.board = &board;
  bundle.lens = options.lens;
  bundle.free_layout = options.solve_layout;
  bundle.free_flatness = options.solve_flatness;
  bundle.offset_sigma_m = options.board_sigma_m > 0.0 ? options.board_sigma_m : 0.01 * board.unit_m();
  bundle.offsets.resize(board.points.size(), {0.0, 0.0, 0.0});
  for (const Observation& view : observations.views) {
    bundle.views.push_back(&view);
    bundle.poses.push_back({0.0, 0.0, 0.0, 0.0, 0.0, 1.0});
    bundle.px.push_back(view.px);
    bundle.used.emplace_back(view.px.size(), view.px.size() >= kFewestPoints);
  }
  return bundle;
}

// Views that no pose explains are left out from the beginning.
void place_views(Bundle& bundle, const ar::CameraModel& camera) {
  const ar::Lens lens(camera);
  for (std::size_t v = 0; v < bundle.views.size(); ++v) {
    const auto pose = best_pose_of(*bundle.board, *bundle.views[v], lens);
    if (pose) bundle.poses[v] = numbers_of(*pose);
    if (!pose || !std::isfinite(view_rms_px(*bundle.board, *bundle.views[v], lens, *pose))) {
      bundle.used[v].assign(bundle.used[v].size(), false);
    }
  }
}

double view_cost(const Bundle& bundle, std::size_t view) {
  double cost = 0.0;
  const auto off = residuals(bundle, view);
  for (std::size_t i = 0; i < off.size(); ++i) {
    if (bundle.used[view][i]) cost += std::log1p(squared(off[i]));
  }
  return std::isfinite(cost) ? cost : std::numeric_limits<double>::infinity();
}

// A flat board far away has two poses that look nearly alike; while the lens was not yet known, the wrong one may have
// looked better. Each view gets the other one tried with the lens as it now is.
bool turn_views_over(Bundle& bundle, const ar::CameraModel& camera) {
  const ar::Lens lens(camera);
  bool turned = false;
  for (std::size_t v = 0; v < bundle.views.size(); ++v) {
    const auto poses = poses_of(*bundle.board, *bundle.views[v], lens);
    for (const ar::Rigid3& pose : poses) {
      Bundle attempt = bundle;
      for (std::size_t other = 0; other < bundle.views.size(); ++other) {
        if (other != v) attempt.used[other].assign(attempt.used[other].size(), false);
      }
      attempt.poses[v] = numbers_of(pose);
      MinimiseOptions options;
      options.tolerance = 1e-5;
      options.robust_scale_px = 1.0;
      options.hold_intrinsics = true;
      if (ar::angle_between(pose.rotation, pose_of(bundle.poses[v]).rotation) < 0.05) continue;
      if (!minimise(attempt, options) || !(view_cost(attempt, v) < 0.98 * view_cost(bundle, v))) continue;
      bundle.poses[v] = attempt.poses[v];
      turned = true;
    }
  }
  return turned;
}

// What straight lines through bent edges make of the corners of tags is taken off their measured places.
void straighten_tags(Bundle& bundle, const ar::CameraModel& camera) {
  if (!corners_cross_edges(*bundle.board)) return;
  const ar::Lens lens(camera);
  if (!lens.bends_lines()) return;
  for (std::size_t v = 0; v < bundle.views.size(); ++v) {
    const Observation& view = *bundle.views[v];
    for (std::size_t i = 0; i + 3 < view.points.size(); i += 4) {
      ar::SeenTag tag;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto point = static_cast<std::size_t>(view.points[i + k]);
        tag.corners_in_world[k] = bundle.point_on_board(point);
        tag.measured_px[k] = tag.corners_px[k] = view.px[i + k];
      }
      ar::straighten(lens, pose_of(bundle.poses[v]).inverse(), tag);
      for (std::size_t k = 0; k < 4; ++k) bundle.px[v][i + k] = tag.corners_px[k];
    }
  }
}

// Noise of one coordinate as most corners show it, whatever a few do.
double typical_noise_px(const Bundle& bundle) {
  std::vector<double> off;
  for (std::size_t v = 0; v < bundle.views.size(); ++v) {
    const auto all = residuals(bundle, v);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!bundle.used[v][i] || !std::isfinite(all[i].x)) continue;
      off.push_back(std::abs(all[i].x));
      off.push_back(std::abs(all[i].y));
    }
  }
  if (off.empty()) return kQuietestPx;
  return std::max(kQuietestPx, 1.4826 * render::upper_median(std::move(off)));  // of a normal distribution
}

// Leaves out corners that do not fit, and views of which most do not. Corners that were left out and fit now come back.
bool choose_used(Bundle& bundle, double noise_px) {
  bool changed = false;
  const double limit = kOutlierSigmas * noise_px;
  for (std::size_t v = 0; v < bundle.views.size(); ++v) {
    if (bundle.px[v].size() < kFewestPoints) continue;
    const auto off = residuals(bundle, v);
    std::vector<bool> used;
    for (const cv::Point2d& r : off) used.push_back(squared(r) <= limit * limit);
    const auto good = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
    if (good < kFewestPoints || 2 * good < used.size()) used.assign(used.size(), false);
    changed = changed || used != bundle.used[v];
    bundle.used[v] = used;
  }
  return changed;
}

Solution described(const Bundle& bundle, const Observations& observations) {
  Solution out;
  out.lens = bundle.lens;
  out.intrinsics = bundle.intrinsics;
  out.camera = camera_of(bundle.lens, bundle.intrinsics, observations.width, observations.height);
  double sum = 0.0;
  int poses = 0;
  for (std::size_t v = 0; v < bundle.views.size(); ++v) {
    ViewFit fit;
    fit.camera_from_board = pose_of(bundle.poses[v]);
    fit.residual_px = residuals(bundle, v);
    fit.used = bundle.used[v];
    double view_sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < fit.used.size(); ++i) {
      if (!fit.used[i]) continue;
      view_sum += squared(fit.residual_px[i]);
      ++count;
    }
    if (count > 0) fit.rms_px = std::sqrt(view_sum / count);
    poses += count > 0 ? 1 : 0;
    sum += view_sum;
    out.points_used += count;
    out.points_rejected += static_cast<int>(fit.used.size()) - count;
    out.views.push_back(std::move(fit));
  }
  const double freedom = 2.0 * out.points_used - 6.0 * poses - static_cast<double>(bundle.intrinsics.size());
  out.rms_px = out.points_used > 0 ? std::sqrt(sum / out.points_used) : 0.0;
  out.sigma_px = freedom > 0.0 ? std::sqrt(sum / freedom) : std::numeric_limits<double>::infinity();
  const Information information = intrinsics_information(bundle, std::max(out.sigma_px, kQuietestPx));
  out.local_covariance = information.covariance * (out.sigma_px * out.sigma_px);
  out.covariance = out.local_covariance;
  out.conditioning = information.conditioning;
  if (out.conditioning < kWeak) out.covariance = widened_along_weakest(bundle, out.local_covariance, out.sigma_px);
  if (bundle.frees_offsets()) {
    for (const auto& offset : bundle.offsets) out.board_error.emplace_back(offset[0], offset[1], offset[2]);
  }
  return out;
}

// Distortion comes in when focal length and poses are about right: before, it would explain what they should.
bool first_fit(Bundle& bundle, const SolveOptions& options) {
  MinimiseOptions robust;
  robust.tolerance = 1e-5;
  robust.robust_scale_px = options.start ? 1.0 : 3.0;
  robust.hold_distortion = true;
  if (!options.start && !minimise(bundle, robust)) return false;
  robust.hold_distortion = false;
  if (!options.start && !minimise(bundle, robust)) return false;
  robust.robust_scale_px = 1.0;
  return minimise(bundle, robust);
}

}  // namespace

bool ViewFit::any_used() const {
  return std::find(used.begin(), used.end(), true) != used.end();
}

double Solution::sigma_of(int intrinsic) const {
  return std::sqrt(covariance(intrinsic, intrinsic));
}

std::vector<std::size_t> Solution::used_views() const {
  std::vector<std::size_t> used;
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (views[v].any_used()) used.push_back(v);
  }
  return used;
}

std::optional<Solution> solve(const Board& board, const Observations& observations, const SolveOptions& options) {
  Bundle bundle = make_bundle(board, observations, options);
  ar::CameraModel camera;
  if (options.start) {
    camera = *options.start;
  } else {
    const auto start = find_start(board, observations, options.lens);
    if (!start) return std::nullopt;
    camera = start->camera;
  }
  bundle.intrinsics = intrinsics_of(options.lens, camera);
  place_views(bundle, camera);
  // Board errors wait until the camera is about right.
  const bool layout = std::exchange(bundle.free_layout, false);
  const bool flatness = std::exchange(bundle.free_flatness, false);
  if (!first_fit(bundle, options)) return std::nullopt;
  const auto camera_now = [&] {
    return camera_of(bundle.lens, bundle.intrinsics, observations.width, observations.height);
  };
  MinimiseOptions robust;
  robust.tolerance = 1e-5;
  robust.robust_scale_px = 1.0;
  if (!options.start && turn_views_over(bundle, camera_now()) && !minimise(bundle, robust)) return std::nullopt;
  bundle.free_layout = layout;
  bundle.free_flatness = flatness;
  MinimiseOptions squares;
  for (int round = 0; round < 6; ++round) {
    straighten_tags(bundle, camera_now());
    squares.noise_px = typical_noise_px(bundle);
    const bool changed = options.reject_outliers && choose_used(bundle, squares.noise_px);
    const bool bent = corners_cross_edges(board) && round < 2;
    if (round > 0 && !changed && !bent) break;
    if (!minimise(bundle, squares)) return std::nullopt;
  }
  return described(bundle, observations);
}

std::optional<PoseFit> fit_view(const Board& board, const Observation& view, const std::vector<bool>& used,
                                const ar::CameraModel& camera) {
  const auto pose = best_pose_of(board, view, ar::Lens(camera));
  if (!pose) return std::nullopt;
  Observations one;
  one.width = camera.width;
  one.height = camera.height;
  one.views = {view};
  SolveOptions options;
  options.lens = lens_choice_of(camera);
  Bundle bundle = make_bundle(board, one, options);
  bundle.intrinsics = intrinsics_of(options.lens, camera);
  bundle.poses[0] = numbers_of(*pose);
  bundle.used[0] = used;
  straighten_tags(bundle, camera);
  MinimiseOptions hold;
  hold.hold_intrinsics = true;
  if (!minimise(bundle, hold)) return std::nullopt;
  PoseFit fit{pose_of(bundle.poses[0]), 0.0};
  const auto off = residuals(bundle, 0);
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < off.size(); ++i) {
    if (!used[i]) continue;
    sum += squared(off[i]);
    ++count;
  }
  fit.rms_px = std::sqrt(sum / std::max(1, count));
  return fit;
}

}  // namespace calib
