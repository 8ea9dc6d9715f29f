#include "ar/track/search_regions.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ar {
namespace {

// Standard deviation of a world point's pixel, px, from the pose's covariance.
double pixel_sigma(const cv::Matx23d& pixel_by_point, const Rigid3& camera_from_world,
                   const cv::Vec3d& from_camera_in_world, const cv::Matx66d& covariance) {
  const cv::Matx23d by_shift = -(pixel_by_point * camera_from_world.rotation);
  const cv::Matx23d by_turn = -(by_shift * cross_matrix(from_camera_in_world));
  cv::Matx<double, 2, 6> jacobian;
  for (int r = 0; r < 2; ++r) {
    for (int c = 0; c < 3; ++c) {
      jacobian(r, c) = by_turn(r, c);
      jacobian(r, c + 3) = by_shift(r, c);
    }
  }
  return std::sqrt(std::max(0.0, cv::trace(jacobian * covariance * jacobian.t())));
}

struct Expected {
  cv::Rect box;
  double side_px = 0.0;
};

std::optional<Expected> expected_tag(const Lens& lens, const cv::Size& picture, const MappedTag& tag,
                                     const Rigid3& world_from_camera, const cv::Matx66d& covariance) {
  const Rigid3 camera_from_world = world_from_camera.inverse();
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9, sigma = 0.0;
  for (const cv::Vec3d& corner : corners_in_tag(tag.size_m)) {
    const cv::Vec3d in_world = tag.world_from_tag * corner;
    cv::Matx23d by_point;
    const auto pixel = lens.project(camera_from_world * in_world, &by_point);
    if (!pixel) return std::nullopt;
    left = std::min(left, pixel->x);
    right = std::max(right, pixel->x);
    top = std::min(top, pixel->y);
    bottom = std::max(bottom, pixel->y);
    sigma =
        std::max(sigma, pixel_sigma(by_point, camera_from_world, in_world - world_from_camera.translation, covariance));
  }
  const double side = std::max(right - left, bottom - top);
  constexpr double kSmallestSide = 6.0;  // px; no tag is read below
  if (!(side >= kSmallestSide)) return std::nullopt;
  // The white border and the library's need of some surroundings, then what the prediction may be off by.
  const double margin = std::min(16.0 + 0.4 * side + 3.0 * sigma, 4.0 * (picture.width + picture.height));
  constexpr int kGrid = 24;
  const auto down = [](double v) { return kGrid * static_cast<int>(std::floor(std::clamp(v, -1e6, 1e6) / kGrid)); };
  const cv::Point low(down(left - margin), down(top - margin));
  const cv::Point high(down(right + margin) + kGrid, down(bottom + margin) + kGrid);
  const cv::Rect box = cv::Rect(low, high) & cv::Rect({0, 0}, picture);
  if (box.empty()) return std::nullopt;
  return Expected{box, side};
}

void add_merged(std::vector<cv::Rect>& regions, cv::Rect region) {
  for (std::size_t i = 0; i < regions.size();) {
    if ((regions[i] & region).empty()) {
      ++i;
      continue;
    }
    region |= regions[i];
    regions.erase(regions.begin() + static_cast<std::ptrdiff_t>(i));
    i = 0;  // the grown box may touch those that were passed already
  }
  regions.push_back(region);
}

}  // namespace

SearchRegions search_regions(const Lens& lens, const cv::Size& picture, const TagMap& map,
                             const Rigid3& world_from_camera, const cv::Matx66d& covariance) {
  SearchRegions regions;
  regions.smallest_side_px = std::max(picture.width, picture.height);
  for (const auto& [id, tag] : map.tags) {
    const auto expected = expected_tag(lens, picture, tag, world_from_camera, covariance);
    if (!expected) continue;
    add_merged(regions.boxes, expected->box);
    regions.smallest_side_px = std::min(regions.smallest_side_px, expected->side_px);
  }
  double area = 0.0;
  for (const cv::Rect& box : regions.boxes) area += box.area();
  constexpr double kWorthwhile = 0.7;
  if (area > kWorthwhile * picture.area()) regions.boxes.clear();
  return regions;
}

}  // namespace ar
