#pragma once

#include <array>
#include <glm/glm.hpp>

#include "render/gl/program.h"
#include "render/scene/scene_state.h"

namespace render {

// A scene's light in the form surface shaders take it: pre-exposed single precision.
struct Lighting {
  glm::vec3 sun_direction{0.0F, 0.0F, 1.0F};
  glm::vec3 sun_illuminance{0.0F};
  float sun_disc_slope = 0.0F;                   // tangent of the angular radius
  std::array<glm::vec3, 9> sky_irradiance_sh{};  // convolved with the cosine
  float white_luminance = 0.0F;                  // of white paper lying level in the open

  bool sun_shines() const { return sun_illuminance != glm::vec3(0.0F); }
  void set(const gl::Program& program) const;
};

Lighting lighting_of(const SceneState& scene);

}  // namespace render
