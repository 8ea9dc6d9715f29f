#include "ar/track/solve.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "ar/track/corner_bias.h"
#include "render/base/check.h"
#include "render/base/median.h"

namespace ar {
namespace {

constexpr double kRobustScalePx = 1.5;     // a tag that is off by that much counts half
constexpr double kUnprojectablePx2 = 1e8;  // stands for a tag behind the camera or beyond the lens
constexpr std::size_t kStartTags = 8;      // largest tags whose own poses are tried as starts

struct NormalEquations {
  cv::Matx66d information = cv::Matx66d::zeros();
  cv::Vec6d gradient = cv::Vec6d::all(0.0);
  double cost = 0.0;
};

// Cauchy's loss of a tag's mean squared corner distance, and its derivative.
double robust_loss(double mean_square) {
  constexpr double c2 = kRobustScalePx * kRobustScalePx;
  return c2 * std::log1p(mean_square / c2);
}
double robust_weight(double mean_square) {
  return 1.0 / (1.0 + mean_square / (kRobustScalePx * kRobustScalePx));
}

double squared(const cv::Point2d& p) {
  return p.x * p.x + p.y * p.y;
}

// Sum of squared corner distances of one tag; its J^T J and J^T r are added with weight 1 where asked for.
double tag_squares(const Lens& lens, const SeenTag& tag, const Rigid3& world_from_camera, cv::Matx66d* information,
                   cv::Vec6d* gradient) {
  const cv::Matx33d camera_from_world = world_from_camera.rotation.t();
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const cv::Vec3d from_camera_in_world = tag.corners_in_world[i] - world_from_camera.translation;
    cv::Matx23d by_point;
    const auto pixel = lens.project(camera_from_world * from_camera_in_world, information ? &by_point : nullptr);
    if (!pixel) return kUnprojectablePx2;
    const cv::Point2d residual = tag.corners_px[i] - *pixel;
    sum += squared(residual);
    if (!information) continue;
    // d(point in camera) = R^T [d]x dtheta - R^T dp, for steps as in moved().
    const cv::Matx23d by_turn = by_point * camera_from_world * cross_matrix(from_camera_in_world);
    const cv::Matx23d by_shift = -(by_point * camera_from_world);
    cv::Matx<double, 2, 6> jacobian;
    for (int r = 0; r < 2; ++r) {
      for (int c = 0; c < 3; ++c) {
        jacobian(r, c) = by_turn(r, c);
        jacobian(r, c + 3) = by_shift(r, c);
      }
    }
    *information += jacobian.t() * jacobian;
    *gradient += jacobian.t() * cv::Vec2d(residual.x, residual.y);
  }
  return sum;
}

double robust_cost(const Lens& lens, const std::vector<SeenTag>& tags, const Rigid3& pose) {
  double cost = 0.0;
  for (const SeenTag& tag : tags) cost += 4.0 * robust_loss(tag_squares(lens, tag, pose, nullptr, nullptr) / 4.0);
  return cost;
}

// In px2: the prior is scaled by the corners' variance, so that one number is minimised.
double prior_cost(const PosePrior& prior, const Rigid3& pose) {
  const cv::Vec6d off = step_between(prior.world_from_camera, pose);
  return off.dot(prior.information * off) * prior.corner_sigma_px * prior.corner_sigma_px;
}

NormalEquations normal_equations(const Lens& lens, const std::vector<SeenTag>& tags, const Rigid3& pose,
                                 const std::optional<PosePrior>& prior) {
  NormalEquations sum;
  for (const SeenTag& tag : tags) {
    cv::Matx66d information = cv::Matx66d::zeros();
    cv::Vec6d gradient = cv::Vec6d::all(0.0);
    const double mean_square = tag_squares(lens, tag, pose, &information, &gradient) / 4.0;
    sum.cost += 4.0 * robust_loss(mean_square);
    const double weight = robust_weight(mean_square);
    sum.information += weight * information;
    sum.gradient += weight * gradient;
  }
  if (prior) {
    const double variance = prior->corner_sigma_px * prior->corner_sigma_px;
    sum.cost += prior_cost(*prior, pose);
    sum.information += variance * prior->information;
    sum.gradient -= variance * (prior->information * step_between(prior->world_from_camera, pose));
  }
  return sum;
}

bool is_finite(const Rigid3& pose) {
  for (double v : pose.rotation.val) {
    if (!std::isfinite(v)) return false;
  }
  return std::isfinite(cv::norm(pose.translation));
}

Rigid3 minimise(const Lens& lens, const std::vector<SeenTag>& tags, Rigid3 pose,
                const std::optional<PosePrior>& prior) {
  NormalEquations here = normal_equations(lens, tags, pose, prior);
  double damping = 1e-4;
  for (int iteration = 0; iteration < 40 && damping < 1e8; ++iteration) {
    cv::Matx66d damped = here.information;
    for (int i = 0; i < 6; ++i) damped(i, i) += damping * here.information(i, i) + 1e-12;
    cv::Vec6d step;
    if (!cv::solve(damped, here.gradient, step, cv::DECOMP_CHOLESKY)) return pose;
    const Rigid3 candidate = moved(pose, step);
    if (!is_finite(candidate)) return pose;
    const double cost = robust_cost(lens, tags, candidate) + (prior ? prior_cost(*prior, candidate) : 0.0);
    if (!(cost <= here.cost)) {
      damping = std::max(damping, 1e-6) * 8.0;
      continue;
    }
    const bool done = here.cost - cost <= 1e-9 * (1e-3 + here.cost);
    pose = candidate;
    if (done) return pose;
    damping = std::max(damping * 0.1, 1e-9);
    here = normal_equations(lens, tags, pose, prior);
  }
  return pose;
}

// Tags that stay far from where the rest puts them are left out: more than a pixel and four times the median.
std::vector<bool> agreeing(const std::vector<double>& tag_rms) {
  const double limit = std::max(1.0, 4.0 * render::lower_median(tag_rms));
  std::vector<bool> used(tag_rms.size());
  for (std::size_t i = 0; i < tag_rms.size(); ++i) used[i] = tag_rms[i] <= limit;
  return used;
}

std::optional<PoseFit> described(const Lens& lens, const std::vector<SeenTag>& tags, const Rigid3& pose) {
  std::vector<double> tag_rms;
  for (const SeenTag& tag : tags) tag_rms.push_back(std::sqrt(tag_squares(lens, tag, pose, nullptr, nullptr) / 4.0));
  PoseFit fit;
  fit.world_from_camera = pose;
  fit.used = agreeing(tag_rms);
  fit.cost = robust_cost(lens, tags, pose);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (!fit.used[i]) continue;
    cv::Vec6d unused_gradient = cv::Vec6d::all(0.0);
    const double squares = tag_squares(lens, tags[i], pose, &fit.information, &unused_gradient);
    if (squares >= kUnprojectablePx2) return std::nullopt;
    fit.sum_squares_px2 += squares;
  }
  return fit;
}

// Both poses of one square (Collins and Bartoli 2014, "Infinitesimal plane-based pose estimation").
std::vector<Rigid3> poses_of_tag(const SeenTag& tag) {
  const std::vector<cv::Point2d> ideal(tag.corners_ideal.begin(), tag.corners_ideal.end());
  std::vector<cv::Point3d> model;
  for (const cv::Vec3d& c : corners_in_tag(tag.size_m)) model.emplace_back(c[0], c[1], c[2]);
  std::vector<cv::Mat> turns;
  std::vector<cv::Mat> shifts;
  cv::solvePnPGeneric(model, ideal, cv::Matx33d::eye(), cv::noArray(), turns, shifts, false, cv::SOLVEPNP_IPPE_SQUARE);
  std::vector<Rigid3> poses;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const Rigid3 camera_from_tag{rotation_from_vector(cv::Vec3d(turns[i].ptr<double>())),
                                 cv::Vec3d(shifts[i].ptr<double>())};
    const Rigid3 world_from_camera = tag.world_from_tag * camera_from_tag.inverse();
    if (is_finite(world_from_camera)) poses.push_back(world_from_camera);
  }
  return poses;
}

bool same_pose(const PoseFit& a, const PoseFit& b, const SeenTag& tag) {
  const double distance = cv::norm(a.world_from_camera.translation - tag.world_from_tag.translation);
  return angle_between(a.world_from_camera.rotation, b.world_from_camera.rotation) < 2e-3 &&
         cv::norm(a.world_from_camera.translation - b.world_from_camera.translation) < 2e-3 * distance;
}

}  // namespace

int PoseFit::used_corners() const {
  return 4 * static_cast<int>(std::count(used.begin(), used.end(), true));
}

double PoseFit::rms_px() const {
  const int corners = used_corners();
  return corners > 0 ? std::sqrt(sum_squares_px2 / corners) : 0.0;
}

std::vector<SeenTag> seen_tags(const Lens& lens, const TagMap& map, const std::vector<Detection>& detections) {
  std::vector<SeenTag> tags;
  for (const Detection& d : detections) {
    const auto known = map.tags.find(d.id);
    if (d.family != map.family || known == map.tags.end()) continue;
    SeenTag tag;
    tag.id = d.id;
    tag.size_m = known->second.size_m;
    tag.world_from_tag = known->second.world_from_tag;
    tag.measured_px = tag.corners_px = d.corners_px;
    const auto in_tag = corners_in_tag(tag.size_m);
    bool whole = true;
    for (std::size_t i = 0; i < 4; ++i) {
      tag.corners_in_world[i] = tag.world_from_tag * in_tag[i];
      const auto ideal = lens.ideal_from_pixel(d.corners_px[i]);
      whole = whole && ideal.has_value();
      tag.corners_ideal[i] = ideal.value_or(cv::Point2d());
      const cv::Point2d& next = d.corners_px[(i + 1) % 4];
      tag.area_px2 += 0.5 * (next.x * d.corners_px[i].y - d.corners_px[i].x * next.y);
    }
    // A square seen from its face keeps its turning sense and some area.
    if (whole && tag.area_px2 > 1.0) tags.push_back(tag);
  }
  std::stable_sort(tags.begin(), tags.end(),
                   [](const SeenTag& a, const SeenTag& b) { return a.area_px2 > b.area_px2; });
  return tags;
}

std::optional<PoseFit> fit_pose(const Lens& lens, std::vector<SeenTag>& tags, const Rigid3& start,
                                const std::optional<PosePrior>& prior) {
  Rigid3 pose = minimise(lens, tags, start, prior);
  if (lens.bends_lines()) {
    // The correction hardly depends on the pose, so that once more is enough.
    for (SeenTag& tag : tags) straighten(lens, pose, tag);
    pose = minimise(lens, tags, pose, prior);
  }
  std::optional<PoseFit> fit = described(lens, tags, pose);
  if (!fit || std::all_of(fit->used.begin(), fit->used.end(), [](bool used) { return used; })) return fit;
  std::vector<SeenTag> good;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (fit->used[i]) good.push_back(tags[i]);
  }
  return described(lens, tags, minimise(lens, good, pose, prior));
}

std::vector<PoseFit> solve_pose(const Lens& lens, std::vector<SeenTag>& tags, const std::optional<Rigid3>& near) {
  std::vector<Rigid3> starts;
  for (std::size_t i = 0; i < std::min(tags.size(), kStartTags); ++i) {
    for (const Rigid3& pose : poses_of_tag(tags[i])) starts.push_back(pose);
  }
  if (near) starts.push_back(*near);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < starts.size(); ++i) order.emplace_back(robust_cost(lens, tags, starts[i]), i);
  std::sort(order.begin(), order.end());

  constexpr std::size_t kRefined = 4;  // of many starts, most lead to the same two places
  std::vector<PoseFit> fits;
  for (std::size_t i = 0; i < std::min(order.size(), kRefined); ++i) {
    const std::optional<PoseFit> fit = fit_pose(lens, tags, starts[order[i].second]);
    if (!fit) continue;
    const bool known =
        std::any_of(fits.begin(), fits.end(), [&](const PoseFit& f) { return same_pose(f, *fit, tags[0]); });
    if (!known) fits.push_back(*fit);
  }
  std::sort(fits.begin(), fits.end(), [](const PoseFit& a, const PoseFit& b) { return a.cost < b.cost; });
  return fits;
}

double corner_variance_px2(double sum_squares_px2, int corners) {
  CHECK(sum_squares_px2 >= 0.0);
  CHECK(corners >= 0);
  constexpr double kUsual = 0.1 * 0.1;
  constexpr double kWeight = 6.0;  // as if so many further numbers had been measured
  const double freedom = std::max(0, 2 * corners - 6);
  return (kWeight * kUsual + sum_squares_px2) / (kWeight + freedom);
}

}  // namespace ar
