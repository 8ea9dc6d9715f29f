#pragma once

#include <array>

#include "render/shafts/march/closed_form.h"
#include "render/shafts/medium_program.h"
#include "render/shafts/occluder_map.h"
#include "render/shafts/shaft_target.h"

namespace render {

// Ray marching against a map of the occluders with interleaved step offsets and a depth-aware average over their tile
// (Toth & Umenhoffer 2009). Where a ray leaves the space that occluders can shadow, closed forms take over.
// Parameters: steps (rounded up to a multiple of 4), divisor.
class Interleaved : public ShaftTechnique {
 public:
  Interleaved(int steps, int divisor) : steps_((steps + 3) / 4 * 4), divisor_(divisor), open_(divisor) {}

  const ShaftPicture& draw(const ShaftInputs& inputs) override;

 private:
  void make_targets(const glm::ivec2& size_px);
  void average_rows();  // from lit_[0] to lit_[1]

  int steps_;
  int divisor_;
  OccluderMap occluders_{2};
  MediumProgram march_{"shafts/interleaved.frag"};
  gl::Program blur_{"lib/full_screen.vert", "shafts/blur.frag"};
  MediumProgram shading_{MediumProgram::SkyAtCorners{}, "shafts/shading.frag", {{"LIT"}}};
  std::array<gl::Texture, 2> lit_;
  std::array<gl::Framebuffer, 2> lit_target_;
  gl::VertexArray no_vertices_;
  ShaftTarget target_;
  ClosedForm open_;
};

}  // namespace render
