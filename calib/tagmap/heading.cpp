#include "calib/tagmap/heading.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace calib {
namespace {

std::optional<cv::Point2d> on_ground(const ar::Lens& lens, const ar::Rigid3& map_from_camera, const cv::Point2d& px,
                                     double ground_m) {
  const auto ideal = lens.ideal_from_pixel(px);
  if (!ideal) return std::nullopt;
  const cv::Vec3d ray = map_from_camera.rotation * cv::Vec3d(ideal->x, ideal->y, 1.0);
  const cv::Vec3d& eye = map_from_camera.translation;
  const double along = (ground_m - eye[2]) / ray[2];
  if (!(along > 0.0) || !std::isfinite(along)) return std::nullopt;
  return cv::Point2d(eye[0] + along * ray[0], eye[1] + along * ray[1]);
}

// Azimuth in the map's own axes from the edge's foot to the shadow's point.
std::optional<double> shadow_azimuth(const ar::Lens& lens, const ar::Rigid3& map_from_camera,
                                     const ShadowClicks& clicks) {
  const auto base = on_ground(lens, map_from_camera, clicks.base_px, clicks.ground_m);
  const auto tip = on_ground(lens, map_from_camera, clicks.tip_px, clicks.ground_m);
  if (!base || !tip || cv::norm(*tip - *base) < 1e-9) return std::nullopt;
  return std::atan2(tip->x - base->x, tip->y - base->y);
}

}  // namespace

double wrapped(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * std::numbers::pi);
}

Heading heading_from_shadow(const ar::Lens& lens, const ar::Rigid3& map_from_camera, const cv::Matx66d& pose_covariance,
                            const ShadowClicks& clicks, double sun_azimuth_rad) {
  const auto here = shadow_azimuth(lens, map_from_camera, clicks);
  if (!here) {
    throw std::runtime_error(
        fmt::format("the pixels {:g},{:g} and {:g},{:g} do not meet the ground at two places in front of "
                    "the camera\nboth must lie on level ground, below the horizon; is --ground right?",
                    clicks.base_px.x, clicks.base_px.y, clicks.tip_px.x, clicks.tip_px.y));
  }
  const auto change = [&](const ar::Rigid3& pose, const ShadowClicks& moved) {
    const auto there = shadow_azimuth(lens, pose, moved);
    return there ? wrapped(*there - *here) : std::numbers::pi;
  };
  double variance = 0.0;
  for (cv::Point2d ShadowClicks::*click : {&ShadowClicks::base_px, &ShadowClicks::tip_px}) {
    for (const cv::Point2d& step : {cv::Point2d(clicks.sigma_px, 0.0), cv::Point2d(0.0, clicks.sigma_px)}) {
      ShadowClicks moved = clicks;
      moved.*click += step;
      const double by = change(map_from_camera, moved);
      variance += by * by;
    }
  }
  cv::Vec6d by_pose;
  for (int i = 0; i < 6; ++i) {
    cv::Vec6d step = cv::Vec6d::all(0.0);
    step[i] = 1e-6;
    by_pose[i] = change(ar::moved(map_from_camera, step), clicks) / 1e-6;
  }
  variance += by_pose.dot(pose_covariance * by_pose);
  return {wrapped(sun_azimuth_rad + std::numbers::pi - *here), std::sqrt(variance)};
}

bool lies_flat(const ar::Rigid3& world_from_tag) {
  return std::abs(world_from_tag.rotation(2, 2)) > std::numbers::sqrt2 / 2.0;
}

double heading_of_tag(const ar::Rigid3& world_from_tag) {
  // y of a tag runs down its face, z into it.
  const cv::Vec3d way = lies_flat(world_from_tag) ? world_from_tag.rotation * cv::Vec3d(0.0, -1.0, 0.0)
                                                  : world_from_tag.rotation * cv::Vec3d(0.0, 0.0, -1.0);
  return std::atan2(way[0], way[1]);
}

}  // namespace calib
