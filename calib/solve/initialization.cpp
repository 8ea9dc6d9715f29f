#include "calib/solve/initialization.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/calib3d.hpp>

#include "ar/track/lens.h"
#include "render/base/median.h"

namespace calib {
namespace {

constexpr double kUnexplained = std::numeric_limits<double>::infinity();

bool is_flat(const std::vector<cv::Point3d>& points) {
  cv::Mat m = cv::Mat(points).reshape(1).clone();
  cv::Mat mean;
  cv::reduce(m, mean, 0, cv::REDUCE_AVG);
  for (int i = 0; i < m.rows; ++i) m.row(i) -= mean;
  cv::Mat spread;
  cv::SVD::compute(m.t() * m, spread, cv::noArray(), cv::noArray(), cv::SVD::NO_UV);
  return spread.at<double>(2) <= 1e-8 * spread.at<double>(0);
}

bool is_finite(const ar::Rigid3& pose) {
  return std::all_of(std::begin(pose.rotation.val), std::end(pose.rotation.val),
                     [](double v) { return std::isfinite(v); }) &&
         std::isfinite(cv::norm(pose.translation));
}

// Views with the most points tell the focal length best; a dozen are enough.
std::vector<std::size_t> fullest_views(const Observations& observations) {
  std::vector<std::size_t> order(observations.views.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return observations.views[a].points.size() > observations.views[b].points.size();
  });
  order.resize(std::min<std::size_t>(order.size(), 12));
  return order;
}

double cost_of(const Board& board, const Observations& observations, const std::vector<std::size_t>& views,
               const ar::CameraModel& camera) {
  const ar::Lens lens(camera);
  std::vector<double> errors;
  for (std::size_t v : views) {
    double best = kUnexplained;
    for (const ar::Rigid3& pose : poses_of(board, observations.views[v], lens)) {
      best = std::min(best, view_rms_px(board, observations.views[v], lens, pose));
    }
    // A view that no focal length explains must not decide between them.
    errors.push_back(std::min(best, static_cast<double>(observations.width)));
  }
  // Half of the mean over the median: few wrong views do not decide, and all good ones do.
  return render::upper_median(errors) +
         0.1 * std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
}

ar::CameraModel centred_camera(LensChoice lens, double focal_px, int width, int height) {
  std::vector<double> v(static_cast<std::size_t>(intrinsics_count(lens)), 0.0);
  v[0] = v[1] = focal_px;
  v[2] = 0.5 * (width - 1);
  v[3] = 0.5 * (height - 1);
  return camera_of(lens, v, width, height);
}

}  // namespace

std::vector<ar::Rigid3> poses_of(const Board& board, const Observation& view, const ar::Lens& lens) {
  std::vector<cv::Point3d> on_board;
  std::vector<cv::Point2d> ideal;
  for (std::size_t i = 0; i < view.points.size(); ++i) {
    const auto ray = lens.ideal_from_pixel(view.px[i]);
    if (!ray) continue;
    on_board.emplace_back(board.points[static_cast<std::size_t>(view.points[i])]);
    ideal.push_back(*ray);
  }
  if (ideal.size() < 4) return {};
  std::vector<cv::Mat> turns;
  std::vector<cv::Mat> shifts;
  try {
    cv::solvePnPGeneric(on_board, ideal, cv::Matx33d::eye(), cv::noArray(), turns, shifts, false,
                        is_flat(on_board) ? cv::SOLVEPNP_IPPE : cv::SOLVEPNP_SQPNP);
  } catch (const cv::Exception&) {
    return {};  // points in one line, or worse
  }
  std::vector<ar::Rigid3> poses;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const ar::Rigid3 pose{ar::rotation_from_vector(cv::Vec3d(turns[i].ptr<double>())),
                          cv::Vec3d(shifts[i].ptr<double>())};
    if (is_finite(pose)) poses.push_back(pose);
  }
  return poses;
}

double view_rms_px(const Board& board, const Observation& view, const ar::Lens& lens,
                   const ar::Rigid3& camera_from_board) {
  double sum = 0.0;
  for (std::size_t i = 0; i < view.points.size(); ++i) {
    const auto pixel = lens.project(camera_from_board * board.points[static_cast<std::size_t>(view.points[i])]);
    if (!pixel) return kUnexplained;
    const cv::Point2d off = view.px[i] - *pixel;
    sum += off.dot(off);
  }
  return std::sqrt(sum / static_cast<double>(view.points.size()));
}

std::optional<ar::Rigid3> best_pose_of(const Board& board, const Observation& view, const ar::Lens& lens) {
  std::optional<ar::Rigid3> best;
  double best_rms = kUnexplained;
  for (const ar::Rigid3& pose : poses_of(board, view, lens)) {
    const double rms = view_rms_px(board, view, lens, pose);
    if (rms >= best_rms) continue;
    best = pose;
    best_rms = rms;
  }
  return best;
}

std::optional<Start> find_start(const Board& board, const Observations& observations, LensChoice lens) {
  const std::vector<std::size_t> views = fullest_views(observations);
  if (views.empty()) return std::nullopt;
  const double across = std::max(observations.width, observations.height);
  Start best;
  best.rms_px = across;
  double ratio = 0.22;  // fisheye of 260 deg in its own angle; 132 deg of a pinhole
  double step = 1.18;
  double best_ratio = 0.0;
  const auto attempt = [&](double r) {
    const ar::CameraModel camera = centred_camera(lens, r * across, observations.width, observations.height);
    const double rms = cost_of(board, observations, views, camera);
    if (rms >= best.rms_px) return;
    best = {camera, rms};
    best_ratio = r;
  };
  for (; ratio < 12.0; ratio *= step) attempt(ratio);
  if (best_ratio == 0.0) return std::nullopt;
  for (int halving = 0; halving < 3; ++halving) {
    step = std::sqrt(step);
    const double middle = best_ratio;
    attempt(middle * step);
    attempt(middle / step);
  }
  return best;
}

}  // namespace calib
