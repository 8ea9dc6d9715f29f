#include "ar/track/corner_bias.h"

#include <cmath>
#include <optional>

namespace ar {
namespace {

struct Line {
  cv::Point2d point;
  cv::Point2d along;
};

// Total least squares through points spread evenly along an edge, its ends left out: libapriltag's refine_edges().
std::optional<Line> line_through_edge(const Lens& lens, const Rigid3& camera_from_world, const cv::Vec3d& from,
                                      const cv::Vec3d& to) {
  constexpr int kSamples = 16;
  std::array<cv::Point2d, kSamples> points;
  cv::Point2d mean;
  for (int i = 0; i < kSamples; ++i) {
    const double t = (i + 1.0) / (kSamples + 1.0);
    const auto pixel = lens.project(camera_from_world * (from + t * (to - from)));
    if (!pixel) return std::nullopt;
    points[static_cast<std::size_t>(i)] = *pixel;
    mean += *pixel / kSamples;
  }
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const cv::Point2d& p : points) {
    xx += (p.x - mean.x) * (p.x - mean.x);
    xy += (p.x - mean.x) * (p.y - mean.y);
    yy += (p.y - mean.y) * (p.y - mean.y);
  }
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  return Line{mean, {std::cos(angle), std::sin(angle)}};
}

std::optional<cv::Point2d> crossing(const Line& a, const Line& b) {
  const double turn = a.along.cross(b.along);
  if (std::abs(turn) < 1e-3) return std::nullopt;
  return a.point + a.along * ((b.point - a.point).cross(b.along) / turn);
}

}  // namespace

void straighten(const Lens& lens, const Rigid3& world_from_camera, SeenTag& tag) {
  const Rigid3 camera_from_world = world_from_camera.inverse();
  std::array<std::optional<Line>, 4> edges;  // i: from corner i to the next
  for (std::size_t i = 0; i < 4; ++i) {
    edges[i] = line_through_edge(lens, camera_from_world, tag.corners_in_world[i], tag.corners_in_world[(i + 1) % 4]);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& before = edges[(i + 3) % 4];
    const auto& after = edges[i];
    const auto corner = lens.project(camera_from_world * tag.corners_in_world[i]);
    if (!before || !after || !corner) continue;
    const auto fitted = crossing(*before, *after);
    if (fitted) tag.corners_px[i] = tag.measured_px[i] - (*fitted - *corner);
  }
}

}  // namespace ar
