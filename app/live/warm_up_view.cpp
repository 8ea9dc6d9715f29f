#include "app/live/warm_up_view.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <limits>

namespace app {

render::Box bounds_of_virtual_instances(const SceneFile& scene) {
  constexpr double kFar = std::numeric_limits<double>::max();
  render::Box bounds{glm::dvec3(kFar), glm::dvec3(-kFar)};
  for (const SceneInstance& instance : scene.instances) {
    if (instance.real) continue;
    const glm::dmat4 world_from_model =
        render::place_model(instance.position_in_world, instance.heading_rad, instance.scale);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::bvec3 high((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
      const glm::dvec3 in_model = glm::mix(instance.model->bounds_min, instance.model->bounds_max, high);
      const glm::dvec3 in_world(world_from_model * glm::dvec4(in_model, 1.0));
      bounds.min_in_world = glm::min(bounds.min_in_world, in_world);
      bounds.max_in_world = glm::max(bounds.max_in_world, in_world);
    }
  }
  if (bounds.min_in_world.x > bounds.max_in_world.x) return {glm::dvec3(-1.0), glm::dvec3(1.0)};
  return bounds;
}

ar::Rigid3 pose_with_all_in_view(const SceneFile& scene) {
  const render::Box bounds = bounds_of_virtual_instances(scene);
  const glm::dvec3 middle = 0.5 * (bounds.min_in_world + bounds.max_in_world);
  const double distance = std::max(1.0, 1.2 * glm::length(bounds.max_in_world - bounds.min_in_world));
  const glm::dvec3 forward = glm::normalize(glm::dvec3(0.0, 1.0, -0.3));
  const glm::dvec3 right(1.0, 0.0, 0.0);
  const glm::dvec3 down = glm::cross(forward, right);
  const glm::dvec3 eye = middle - distance * forward;
  ar::Rigid3 pose;
  for (int row = 0; row < 3; ++row) {
    pose.rotation(row, 0) = right[row];
    pose.rotation(row, 1) = down[row];
    pose.rotation(row, 2) = forward[row];
    pose.translation[row] = eye[row];
  }
  return pose;
}

}  // namespace app
