#pragma once

#include <array>
#include <map>

#include "render/shafts/caster_map.h"
#include "render/shafts/shade_pass.h"

namespace render {

// Ray marching against a map of the casters with interleaved step offsets and a depth-aware average over their tile
// (Toth & Umenhoffer 2009). Where a ray leaves the space that casters can shade, closed forms take over.
class March : public ShaftTechnique {
 public:
  March(int steps, int divisor) : steps_((steps + 3) / 4 * 4), divisor_(divisor) {}

  const ShaftPicture& draw(const ShaftInputs& inputs) override;

 private:
  const gl::Program& program(const ShaftInputs& inputs);
  void make_targets(const glm::ivec2& size_px);
  void average_rows();  // from lit_[0] to lit_[1]

  int steps_;  // a multiple of 4
  int divisor_;
  CasterMap casters_;
  std::map<int, gl::Program> programs_;
  gl::Program blur_{"lib/full_screen.vert", "shafts/blur.frag"};
  std::array<gl::Texture, 2> lit_;
  std::array<gl::Framebuffer, 2> lit_target_;
  gl::VertexArray no_vertices_;
  ShadePass shade_;
};

}  // namespace render
