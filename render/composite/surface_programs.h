#pragma once

#include <map>

#include "render/gl/program.h"
#include "render/scene/gpu_model.h"

namespace render {

// The variants of shaders/scene/object.frag and real_shadow.frag that a scene's materials and casters need, compiled
// when first asked for.
class SurfacePrograms {
 public:
  struct Casts {
    bool virtual_casters = false;
    bool real_casters = false;
  };

  const gl::Program& object(const Material& material, const GpuModel::Textures& textures, Casts casts);
  const gl::Program& real_shadow(Casts casts);

  // Sets the material's uniforms and binds its textures to units 0 to 4.
  static void set_material(const gl::Program& program, const Material& material, const GpuModel::Textures& textures);

 private:
  std::map<unsigned, gl::Program> object_;
  std::map<unsigned, gl::Program> real_shadow_;
};

}  // namespace render
