#include "render/scene/scene_state.h"

namespace render {

const Sun& sun_of(const SceneState& scene) {
  static const Sun kDark;
  for (const Light& light : scene.lights) {
    if (const Sun* sun = std::get_if<Sun>(&light)) return *sun;
  }
  return kDark;
}

Sun& ensure_sun(SceneState& scene) {
  for (Light& light : scene.lights) {
    if (Sun* sun = std::get_if<Sun>(&light)) return *sun;
  }
  return std::get<Sun>(scene.lights.emplace_back(Sun{}));
}

}  // namespace render
