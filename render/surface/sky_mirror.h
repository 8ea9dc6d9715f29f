#pragma once

#include <glm/vec3.hpp>
#include <memory>

#include "render/gl/cube_texture.h"
#include "render/gl/program.h"
#include "render/scene/scene_state.h"

namespace render {

// What surfaces of every roughness mirror of a scene's sky and ground: render/sky/sky_cube.h as a texture, filtered
// anew when the sky changes and not otherwise.
class SkyMirror {
 public:
  void update(const SceneState& scene);
  // For shaders/surface/shading.glsl.
  void bind(const gl::Program& program) const;

 private:
  void fill();

  gl::CubeTexture cube_;
  // What cube_ shows. Holding the sky keeps its address from being given to another.
  std::shared_ptr<const SkyModel> sky_;
  glm::dvec3 ground_luminance_rgb_{0.0};
  double peak_luminance_ = 0.0;  // what the texels are relative to, so that half floats hold them; cd/m2
  double exposure_ = 0.0;
};

}  // namespace render
