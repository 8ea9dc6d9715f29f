#include "render/shafts/march/interleaved.h"

namespace render {
namespace {

constexpr int kTilePx = 4;

// The march takes its full number of steps across the medium's longest way, and fewer on shorter ones.
float least_step_m(const Medium& medium, int steps) {
  if (!medium.extent) return 1e-9F;
  return static_cast<float>(glm::length(medium.extent->max_in_world - medium.extent->min_in_world) / steps);
}

}  // namespace

void Interleaved::make_targets(const glm::ivec2& size_px) {
  if (lit_[0].width() == size_px.x && lit_[0].height() == size_px.y) return;
  for (std::size_t i = 0; i < 2; ++i) {
    lit_[i] = gl::Texture(GL_RG32F, size_px.x, size_px.y, gl::Filter::Nearest, 1, "lit part of the sunlight");
    lit_target_[i] = gl::Framebuffer({&lit_[i]}, nullptr, "lit part of the sunlight");
  }
}

void Interleaved::average_rows() {
  lit_target_[1].bind();
  blur_.use();
  blur_.bind("lit_and_distance", lit_[0].handle());
  gl::draw_full_screen(no_vertices_);
}

const ShaftPicture& Interleaved::draw(const ShaftInputs& inputs) {
  occluders_.update(inputs);
  if (occluders_.empty()) return open_.draw(inputs);
  const glm::ivec2 size_px = shaft_size(inputs.view, divisor_);
  plain_state();
  make_targets(size_px);
  confine_to(shaft_region(inputs, size_px, kTilePx));  // the averages of the pixels that are shown reach past them
  lit_target_[0].bind();
  const gl::Program& march = march_.use(inputs, size_px);
  march.set("steps", steps_);
  march.set("least_step_m", least_step_m(*inputs.scene.medium, steps_));
  occluders_.bind(march, inputs);
  gl::draw_full_screen(no_vertices_);
  average_rows();
  target_.begin(inputs, size_px);
  shading_.use(inputs, size_px).bind("lit_and_distance", lit_[1].handle());
  shading_.draw();
  glDisable(GL_SCISSOR_TEST);
  return target_.picture();
}

}  // namespace render
