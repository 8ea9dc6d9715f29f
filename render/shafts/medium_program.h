#pragma once

#include <map>
#include <string>

#include "render/gl/buffer.h"
#include "render/gl/program.h"
#include "render/shafts/medium_block.h"
#include "render/shafts/medium_variant.h"
#include "render/shafts/shaft_technique.h"

namespace render {

// A fragment shader over shaders/shafts/ray.glsl in the variants that media and views ask for, each made when first
// used. Software rasterisers draw pixels at the rims of cells twice: cheap shaders take the sky's light from the cells'
// corners (SkyAtCorners), costly ones compute it.
class MediumProgram {
 public:
  // With `sun_disc` for the shader to look at the sun as a disc.
  explicit MediumProgram(std::string fragment_path, gl::Defines defines = {}, bool sun_disc = false,
                         std::string vertex_path = "lib/full_screen.vert")
      : path_(std::move(fragment_path)),
        vertex_path_(std::move(vertex_path)),
        defines_(std::move(defines)),
        sun_disc_(sun_disc) {}
  struct SkyAtCorners {};
  MediumProgram(SkyAtCorners, std::string fragment_path, gl::Defines defines = {})
      : path_(std::move(fragment_path)), defines_(std::move(defines)), sky_at_corners_(true) {}

  // In use, with all that ray.glsl, view_depth.glsl and shading.glsl need for a picture of that size, and what
  // shadow_maps.glsl does where the sun is a disc. Of the medium in that range alone: the nearest also has the sky's
  // light and what the whole ray transmits; the others' is to be added.
  const gl::Program& use(const ShaftInputs& inputs, const glm::ivec2& size_px, const AxisRange& range = {});

  // Draws that picture with the program in use: in cells for a shader with SKY_AT_CORNERS, where the picture is fine
  // enough, else as a whole.
  void draw() const;

 private:
  MediumVariant variant_of(const ShaftInputs& inputs, const glm::ivec2& size_px, const AxisRange& range) const;
  const gl::Program& program_for(const MediumVariant& variant);
  void set_cells(const gl::Program& program, const View& view, const glm::ivec2& size_px);

  std::string path_;
  std::string vertex_path_ = "lib/full_screen.vert";  // unless drawn in cells
  gl::Defines defines_;
  bool sun_disc_ = false;
  bool sky_at_corners_ = false;
  std::map<MediumVariant, gl::Program> programs_;
  MediumBlockBuffer block_;
  glm::ivec2 cells_{0};  // of the picture that is to be drawn; 0: none
  gl::VertexArray no_vertices_;
};

}  // namespace render
