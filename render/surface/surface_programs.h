#pragma once

#include <map>

#include "render/gl/gpu_model.h"
#include "render/gl/program.h"

namespace render {

// Whether a texture cuts holes into the surface.
bool is_cut_out(const Material& material, const GpuModel::Textures& textures);

// The variants of the programs in shaders/scene that a scene's materials and occluders need, compiled when first asked
// for.
class SurfacePrograms {
 public:
  // `quick_shadows`: soft shadows from fewer samples, whose penumbras are coarser.
  explicit SurfacePrograms(bool quick_shadows = false) : quick_shadows_(quick_shadows) {}

  struct Casts {
    bool virtual_occluders = false;
    bool real_occluders = false;
    bool translucent = false;  // tints the light
  };

  // What a virtual surface is drawn for: its depth; its light; that and a mark to know the surface by; smooth edges
  // from light and marks that are there already (shaders/scene/{depth,object,smooth}.frag).
  enum class Use { Depth, Light, MarkedLight, SmoothEdges };
  const gl::Program& virtual_surface(Use use, const Material& material, const GpuModel::Textures& textures,
                                     Casts casts);
  const gl::Program& real_depth() const { return real_depth_; }
  // `sought`: only finds where there may be any (shaders/surface/real_shadow.frag).
  const gl::Program& real_shadow(Casts casts, bool sought);

  // Sets the material's uniforms and binds its textures to units 0 to 4.
  static void set_material(const gl::Program& program, const Material& material, const GpuModel::Textures& textures);

 private:
  bool quick_shadows_;
  std::map<unsigned, gl::Program> virtual_;
  std::map<unsigned, gl::Program> real_shadow_;
  gl::Program real_depth_{"surface/surface.vert", "surface/depth.frag"};
};

}  // namespace render
