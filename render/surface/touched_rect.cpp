#include "render/surface/touched_rect.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace render {
namespace {

constexpr double kLongestShadowM = 1000.0;
constexpr int kPaddingPx = 2;

std::vector<glm::dvec3> corners_in_world(const Instance& instance) {
  std::vector<glm::dvec3> corners;
  const glm::dvec3 low(instance.model->bounds_min);
  const glm::dvec3 high(instance.model->bounds_max);
  for (unsigned i = 0; i < 8; ++i) {
    const glm::dvec4 corner((i & 1U) != 0 ? high.x : low.x, (i & 2U) != 0 ? high.y : low.y,
                            (i & 4U) != 0 ? high.z : low.z, 1.0);
    corners.emplace_back(instance.world_from_model * corner);
  }
  return corners;
}

double lowest_real_m(const SceneState& scene) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Instance& instance : scene.instances) {
    if (!instance.real) continue;
    for (const glm::dvec3& corner : corners_in_world(instance)) lowest = std::min(lowest, corner.z);
  }
  return lowest;
}

// Adds where the corners end up when they are moved along the light, down to the lowest real thing.
void sweep_along_light(std::vector<glm::dvec3>& corners, const SceneState& scene, double lowest_m) {
  const glm::dvec3 sun = sun_of(scene).direction_in_world;
  if (sun_of(scene).illuminance_rgb == glm::dvec3(0.0) || !std::isfinite(lowest_m)) return;
  const std::size_t count = corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double drop = std::max(corners[i].z - lowest_m, 0.0);
    const double length = sun.z > 1e-6 ? std::min(drop / sun.z, kLongestShadowM) : kLongestShadowM;
    corners.push_back(corners[i] - length * sun);
  }
}

struct Extent {
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};
};

// Pixels spanned by the convex hull of the points: what is behind the near plane is cut off, and the cut of a hull is
// spanned by the cuts of all lines between its points.
void add_hull(Extent& extent, const std::vector<glm::dvec3>& points_in_world, const View& view) {
  const glm::dmat3 camera_from_world = glm::transpose(view.world_from_camera);
  std::vector<glm::dvec3> points;
  for (const glm::dvec3& point : points_in_world) points.push_back(camera_from_world * (point - view.eye_in_world));
  const auto add = [&](const glm::dvec3& p) {
    const glm::dvec2 px = view.focal_px * glm::dvec2(p) / p.z + view.centre_px;
    extent.low = glm::min(extent.low, px);
    extent.high = glm::max(extent.high, px);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].z >= View::kNearM) add(points[i]);
    for (std::size_t j = 0; j < i; ++j) {
      const double a = points[i].z - View::kNearM;
      const double b = points[j].z - View::kNearM;
      if ((a < 0.0) != (b < 0.0)) add(glm::mix(points[i], points[j], a / (a - b)));
    }
  }
}

PixelRect rect_of(const SceneState& scene, const View& view, bool with_shadows) {
  const double lowest_m = lowest_real_m(scene);
  Extent extent;
  for (const Instance& instance : scene.instances) {
    if (instance.real) continue;
    std::vector<glm::dvec3> corners = corners_in_world(instance);
    if (with_shadows) sweep_along_light(corners, scene, lowest_m);
    add_hull(extent, corners, view);
  }
  const glm::dvec2 size(view.width, view.height);
  const glm::dvec2 low = glm::clamp(glm::floor(extent.low) - double{kPaddingPx}, glm::dvec2(0.0), size);
  const glm::dvec2 high = glm::clamp(glm::ceil(extent.high) + double{kPaddingPx}, glm::dvec2(0.0), size);
  if (!(low.x < high.x && low.y < high.y)) return {};
  return {static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(high.x - low.x),
          static_cast<int>(high.y - low.y)};
}

}  // namespace

PixelRect covered_rect(const SceneState& scene, const View& view) {
  return rect_of(scene, view, false);
}

PixelRect touched_rect(const SceneState& scene, const View& view) {
  return rect_of(scene, view, true);
}

}  // namespace render
