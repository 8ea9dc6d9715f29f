#include "tests/testing/virtual_walk.h"

#include <cmath>
#include <numbers>

#include "ar/track/lens.h"

namespace ar::testing {

Rigid3 looking_at(const cv::Vec3d& eye, const cv::Vec3d& target) {
  const cv::Vec3d z = cv::normalize(target - eye);
  const cv::Vec3d x = cv::normalize(z.cross(cv::Vec3d(0.0, 0.0, 1.0)));
  const cv::Vec3d y = z.cross(x);
  return {{x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]}, eye};
}

Rigid3 world_from_camera_on_walk(double time_s, double distance_m, int variant, double restless) {
  const auto sway = [&](double amplitude, double hertz, double phase) {
    return restless * amplitude * std::sin(2.0 * std::numbers::pi * hertz * time_s + phase + 1.3 * variant);
  };
  const double elevation = 0.35 + 0.13 * (variant % 7) + sway(0.05, 0.3, 0.0);
  const double azimuth = 0.4 * variant + sway(0.3, 0.2, 1.0);
  const double distance = distance_m * (1.0 + sway(0.1, 0.15, 2.0));
  const cv::Vec3d eye(distance * std::cos(elevation) * std::sin(azimuth) + sway(0.01, 1.7, 0.3),
                      -distance * std::cos(elevation) * std::cos(azimuth) + sway(0.01, 2.1, 1.3),
                      distance * std::sin(elevation) + sway(0.01, 1.3, 2.3));
  Rigid3 pose = looking_at(eye, {sway(0.1, 0.25, 4.0), sway(0.1, 0.31, 5.0), 0.0});
  pose.rotation =
      rotation_from_vector({sway(0.005, 3.1, 0.2), sway(0.005, 2.7, 0.5), sway(0.005, 3.7, 0.9)}) * pose.rotation;
  return pose;
}

std::vector<Detection> seen_from(const CameraModel& camera, const TagMap& map, const Rigid3& world_from_camera,
                                 double noise_px, std::mt19937& random) {
  const Lens lens(camera);
  const Rigid3 camera_from_world = world_from_camera.inverse();
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<Detection> found;
  for (const auto& [id, tag] : map.tags) {
    Detection d;
    d.family = map.family;
    d.id = id;
    d.margin = 80.0;
    const cv::Vec3d face = tag.world_from_tag.rotation * cv::Vec3d(0.0, 0.0, 1.0);
    bool visible = face.dot(tag.world_from_tag.translation - world_from_camera.translation) > 0.0;
    const auto corners = corners_in_tag(tag.size_m);
    for (std::size_t i = 0; i < 4 && visible; ++i) {
      const auto pixel = lens.project(camera_from_world * (tag.world_from_tag * corners[i]));
      visible = pixel && pixel->x >= 0.0 && pixel->y >= 0.0 && pixel->x <= camera.width - 1.0 &&
                pixel->y <= camera.height - 1.0;
      if (visible) d.corners_px[i] = *pixel + noise_px * cv::Point2d(noise(random), noise(random));
    }
    if (visible) found.push_back(d);
  }
  return found;
}

}  // namespace ar::testing
