#include "ar/track/tag_map.h"

#include <cmath>

namespace ar {
namespace {

// Columns are the tag's axes in the world: x right, y down, z into the tag.
Rigid3 from_axes(const cv::Vec3d& y, const cv::Vec3d& z, const cv::Vec3d& position_in_world) {
  const cv::Vec3d x = y.cross(z);
  return {{x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]}, position_in_world};
}

cv::Vec3d direction_of_heading(double heading_rad) {
  return {std::sin(heading_rad), std::cos(heading_rad), 0.0};
}

}  // namespace

std::array<cv::Vec3d, 4> corners_in_tag(double size_m) {
  const double s = 0.5 * size_m;
  return {cv::Vec3d(-s, s, 0.0), cv::Vec3d(s, s, 0.0), cv::Vec3d(s, -s, 0.0), cv::Vec3d(-s, -s, 0.0)};
}

Rigid3 flat_tag(const cv::Vec3d& position_in_world, double top_edge_heading_rad) {
  return from_axes(-direction_of_heading(top_edge_heading_rad), {0.0, 0.0, -1.0}, position_in_world);
}

Rigid3 wall_tag(const cv::Vec3d& position_in_world, double faces_heading_rad) {
  return from_axes({0.0, 0.0, -1.0}, -direction_of_heading(faces_heading_rad), position_in_world);
}

}  // namespace ar
