#include "render/shafts/march/bilateral.h"

namespace render {

void Bilateral::draw_small(const ShaftInputs& inputs, const glm::ivec2& small_px) {
  if (small_.width() != small_px.x || small_.height() != small_px.y) {
    small_ = gl::Texture(GL_RG32F, small_px.x, small_px.y, gl::Filter::Nearest, 1, "lit part of the sunlight, small");
    to_small_ = gl::Framebuffer({&small_}, nullptr, "lit part of the sunlight, small");
  }
  plain_state();
  confine_to(shaft_region(inputs, small_px, radius_px_ + 1));
  to_small_.bind();
  const gl::Program& march = march_.use(inputs, small_px);
  steps_.set(march);
  occluders_.bind(march, inputs);
  gl::draw_full_screen(no_vertices_);
}

const ShaftPicture& Bilateral::draw(const ShaftInputs& inputs) {
  occluders_.update(inputs);
  if (occluders_.empty()) return open_.draw(inputs);
  const glm::ivec2 size_px = shaft_size(inputs.view, 1);
  const glm::ivec2 small_px = shaft_size(inputs.view, divisor_);
  draw_small(inputs, small_px);
  target_.begin(inputs, size_px);
  const gl::Program& upscale = upscale_.use(inputs, size_px);
  upscale.bind("small", small_.handle());
  upscale.set("small_px_per_px", glm::vec2(small_px) / glm::vec2(size_px));
  upscale.set("radius", radius_px_);
  upscale_.draw();
  glDisable(GL_SCISSOR_TEST);
  return target_.picture();
}

}  // namespace render
