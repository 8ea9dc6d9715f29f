#include "app/synth/gaze.h"

#include <algorithm>
#include <cmath>

namespace app::synth {

Gaze::Gaze(const Spec& spec, const CameraPath& path) {
  std::vector<cv::Point2d> border;
  for (int i = 0; i <= 16; ++i) {
    const double x = spec.width * i / 16.0 - 0.5;
    const double y = spec.height * i / 16.0 - 0.5;
    for (const cv::Point2d& p : {cv::Point2d(x, -0.5), cv::Point2d(x, spec.height - 0.5), cv::Point2d(-0.5, y),
                                 cv::Point2d(spec.width - 0.5, y)})
      border.push_back(p);
  }
  double widest = 0.0;
  for (const cv::Point2d& ideal : ar::undistort_to_ideal(spec.camera, border)) {
    if (!std::isfinite(ideal.x)) return;
    widest = std::max(widest, std::atan(std::hypot(ideal.x, ideal.y)));
  }
  constexpr double kMargin = 0.05;  // blur, shutter time, and what moves between two frames
  half_angle_rad_ = static_cast<float>(widest + kMargin);
  for (int frame = 0; frame < spec.frames; ++frame) {
    const ar::Rigid3 pose = path.world_from_camera(spec.time_of_frame_s(frame));
    const glm::dvec3 eye(pose.translation[0], pose.translation[1], pose.translation[2]);
    const glm::dvec3 axis(pose.rotation(0, 2), pose.rotation(1, 2), pose.rotation(2, 2));
    views_.push_back({glm::vec3(eye), glm::vec3(axis)});
  }
}

bool Gaze::sees(const glm::vec3& centre, float radius_m) const {
  if (views_.empty()) return true;
  return std::any_of(views_.begin(), views_.end(), [&](const View& view) {
    const glm::vec3 to = centre - view.eye;
    const float distance = glm::length(to);
    if (distance <= radius_m) return true;
    const float apart = std::acos(glm::clamp(glm::dot(to, view.axis) / distance, -1.0F, 1.0F));
    return apart <= half_angle_rad_ + std::asin(radius_m / distance);
  });
}

bool Gaze::sees_far(const glm::vec3& direction, float half_angle_rad) const {
  if (views_.empty()) return true;
  return std::any_of(views_.begin(), views_.end(), [&](const View& view) {
    return std::acos(glm::clamp(glm::dot(direction, view.axis), -1.0F, 1.0F)) <= half_angle_rad_ + half_angle_rad;
  });
}

}  // namespace app::synth
