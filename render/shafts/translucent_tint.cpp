#include "render/shafts/translucent_tint.h"

namespace render {

void TranslucentTint::make_storage(const ShaftPicture& size) {
  if (tinted_.width() == size.width && tinted_.height() == size.height) return;
  tinted_ = gl::Texture(GL_RGBA16F, size.width, size.height, gl::Filter::Linear, 1, "tinted shafts");
  framebuffer_ = gl::Framebuffer({&tinted_}, nullptr, "tinted shafts");
}

const ShaftPicture& TranslucentTint::draw(const ShaftInputs& inputs, const ShaftPicture& untinted) {
  occluders_.update(inputs);
  make_storage(untinted);
  const glm::ivec2 size_px(untinted.width, untinted.height);
  plain_state();
  framebuffer_.bind();
  const gl::Program& program = (occluders_.empty() ? alone_ : among_occluders_).use(inputs, size_px);
  if (!occluders_.empty()) occluders_.bind(program, inputs);
  inputs.shadow.bind_translucent(inputs.view, program);
  program.set("steps", kSteps);
  program.bind("untinted", {GL_TEXTURE_2D, untinted.texture});
  (occluders_.empty() ? alone_ : among_occluders_).draw();
  picture_ = untinted;
  picture_.texture = tinted_.id();
  return picture_;
}

}  // namespace render
