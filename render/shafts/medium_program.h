#pragma once

#include <map>
#include <string>

#include "render/gl/buffer.h"
#include "render/gl/program.h"
#include "render/shafts/shaft_technique.h"

namespace render {

// A fragment shader over shaders/shafts/ray.glsl in the variants that media and views ask for (NO_DEPTH, DIVIDED,
// BOUNDED, FALLOFF, CASCADE), each made when first used. Software rasterisers draw pixels at the rims of cells twice:
// cheap shaders take the sky's light from the cells' corners (SkyAtCorners), costly ones compute it.
class MediumProgram {
 public:
  // With `sun_disc` for the shader to look at the sun as a disc (SUN_DISC, VIRTUAL_OCCLUDERS, REAL_OCCLUDERS).
  explicit MediumProgram(std::string fragment_path, gl::Defines defines = {}, bool sun_disc = false,
                         std::string vertex_path = "lib/full_screen.vert")
      : path_(std::move(fragment_path)),
        vertex_path_(std::move(vertex_path)),
        defines_(std::move(defines)),
        sun_disc_(sun_disc) {}
  struct SkyAtCorners {};
  MediumProgram(SkyAtCorners, std::string fragment_path, gl::Defines defines = {})
      : path_(std::move(fragment_path)), defines_(std::move(defines)), sky_at_corners_(true) {}

  // In use, with all that ray.glsl, view_depth.glsl and shade.glsl need for a picture of that size, on texture unit 0;
  // and what sun_map.glsl does where the sun is a disc, on units 2 to 7, which release() lets go of. Of the medium in
  // that range alone: the nearest also has the sky's light and what the whole ray lets through; the others' is to be
  // added.
  const gl::Program& use(const ShaftInputs& inputs, const glm::ivec2& size_px, const AxisRange& range = {});
  void release() const;

  // Draws that picture with the program in use: in cells for a shader with SKY_AT_CORNERS, where the picture is fine
  // enough, else as a whole.
  void draw() const;

 private:
  int variant_of(const ShaftInputs& inputs, const glm::ivec2& size_px, const AxisRange& range) const;
  gl::Defines defines_of(int variant) const;
  void set_cells(const gl::Program& program, const View& view, const glm::ivec2& size_px);
  void set_sun_disc(const gl::Program& program, const ShaftInputs& inputs) const;

  std::string path_;
  std::string vertex_path_ = "lib/full_screen.vert";  // unless drawn in cells
  gl::Defines defines_;
  bool sun_disc_ = false;
  bool sky_at_corners_ = false;
  std::map<int, gl::Program> variants_;
  glm::ivec2 cells_{0};  // of the picture that is to be drawn; 0: none
  gl::VertexArray no_vertices_;
};

}  // namespace render
