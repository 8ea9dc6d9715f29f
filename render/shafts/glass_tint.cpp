#include "render/shafts/glass_tint.h"

namespace render {
namespace {

constexpr int kPictureUnit = 1;
constexpr int kGlassUnit = 2;  // and 3
// Through the light behind the panes alone, which is seldom many metres: its edges are as sharp as a march of many
// times as many steps along whole rays makes them.
constexpr int kSteps = 128;

}  // namespace

void GlassTint::make_storage(const ShaftPicture& size) {
  if (tinted_.width() == size.width && tinted_.height() == size.height) return;
  tinted_ = gl::Texture(GL_RGBA16F, size.width, size.height, gl::Filter::Linear, 1, "tinted shafts");
  framebuffer_ = gl::Framebuffer({&tinted_}, nullptr, "tinted shafts");
}

const ShaftPicture& GlassTint::draw(const ShaftInputs& inputs) {
  const ShaftPicture& untinted = untinted_->draw(inputs);
  if (inputs.shadow.glass().fit.empty) return untinted;
  casters_.update(inputs);
  make_storage(untinted);
  const glm::ivec2 size_px(untinted.width, untinted.height);
  plain_state();
  framebuffer_.bind();
  const gl::Program& program = (casters_.empty() ? alone_ : among_casters_).use(inputs, size_px);
  if (!casters_.empty()) casters_.bind(program, inputs, kMapUnit);
  inputs.shadow.bind_glass(inputs.view, program, kGlassUnit);
  program.set("steps", kSteps);
  program.set("untinted", kPictureUnit);
  glActiveTexture(GL_TEXTURE0 + kPictureUnit);
  glBindTexture(GL_TEXTURE_2D, untinted.texture);
  (casters_.empty() ? alone_ : among_casters_).draw();
  if (!casters_.empty()) CasterMap::unbind(kMapUnit);
  picture_ = untinted;
  picture_.texture = tinted_.id();
  return picture_;
}

}  // namespace render
