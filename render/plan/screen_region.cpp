#include "render/plan/screen_region.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace render {

PixelRect medium_region(const View& view, const Medium& medium) {
  const PixelRect whole{0, 0, view.width, view.height};
  if (!medium.extent) return whole;
  const glm::dmat3 camera_from_world = glm::transpose(view.world_from_camera);
  glm::dvec2 low(std::numeric_limits<double>::max());
  glm::dvec2 high(std::numeric_limits<double>::lowest());
  int behind = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 in_world = glm::mix(medium.extent->min_in_world, medium.extent->max_in_world,
                                         glm::bvec3((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0));
    const glm::dvec3 in_camera = camera_from_world * (in_world - view.eye_in_world);
    if (in_camera.z <= View::kNearM) {
      ++behind;
      continue;
    }
    const glm::dvec2 px = glm::dvec2(in_camera) / in_camera.z * view.focal_px + view.centre_px;
    low = glm::min(low, px);
    high = glm::max(high, px);
  }
  if (behind == 8) return {};
  if (behind > 0) return whole;
  const glm::dvec2 size(view.width, view.height);
  const glm::dvec2 from = glm::clamp(glm::floor(low), glm::dvec2(0.0), size);
  const glm::dvec2 to = glm::clamp(glm::ceil(high), glm::dvec2(0.0), size);
  return {static_cast<int>(from.x), static_cast<int>(from.y), static_cast<int>(to.x - from.x),
          static_cast<int>(to.y - from.y)};
}

}  // namespace render
