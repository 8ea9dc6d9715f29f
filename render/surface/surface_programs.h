#pragma once

#include <map>
#include <string>

#include "render/gl/gpu_model.h"
#include "render/gl/program.h"
#include "render/surface/surface_variant.h"

namespace render {

// Whether a texture cuts holes into the surface.
bool is_cut_out(const Material& material, const GpuModel::Textures& textures);

// The variants of the programs in shaders/surface that a scene's materials and occluders need, compiled when first
// asked for.
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
  // from light and marks that are there already (shaders/surface/{depth,object,smooth}.frag).
  enum class Use { Depth, Light, MarkedLight, SmoothEdges };
  const gl::Program& virtual_surface(Use use, const Material& material, const GpuModel::Textures& textures,
                                     Casts casts);
  const gl::Program& real_depth() const { return real_depth_; }
  // `sought`: only finds where there may be any (shaders/surface/real_shadow.frag).
  const gl::Program& real_shadow(Casts casts, bool sought);

  // Sets the material's uniforms and binds its textures, as far as the program reads them.
  static void set_material(const gl::Program& program, const Material& material, const GpuModel::Textures& textures);

 private:
  const gl::Program& program_for(const char* shader, const SurfaceVariant& variant);

  bool quick_shadows_;
  std::map<std::pair<std::string, SurfaceVariant>, gl::Program> programs_;
  gl::Program real_depth_{"surface/surface.vert", "surface/depth.frag"};
};

}  // namespace render
