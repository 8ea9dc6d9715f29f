#include "render/shafts/march.h"

namespace render {
namespace {

constexpr int kMapUnit = 8;
constexpr int kTilePx = 4;

// The march takes its full number of steps across the medium's longest way, and fewer on shorter ones.
float least_step_m(const Medium& medium, int steps) {
  if (!medium.extent) return 1e-9F;
  return static_cast<float>(glm::length(medium.extent->max_in_world - medium.extent->min_in_world) / steps);
}

}  // namespace

const gl::Program& March::program(const ShaftInputs& inputs) {
  const bool bounded = inputs.scene.medium->extent.has_value();
  const int key = (bounded ? 1 : 0) + (inputs.depth != 0 ? 2 : 0);
  auto found = programs_.find(key);
  if (found == programs_.end()) {
    gl::Defines defines;
    if (bounded) defines.push_back({"BOUNDED"});
    if (inputs.depth == 0) defines.push_back({"NO_DEPTH"});
    found = programs_.emplace(key, gl::Program("lib/full_screen.vert", "shafts/march.frag", defines)).first;
  }
  return found->second;
}

void March::make_targets(const glm::ivec2& size_px) {
  if (lit_[0].width() == size_px.x && lit_[0].height() == size_px.y) return;
  for (std::size_t i = 0; i < 2; ++i) {
    lit_[i] = gl::Texture(GL_RG32F, size_px.x, size_px.y, gl::Filter::Nearest, 1, "lit part of the sunlight");
    lit_target_[i] = gl::Framebuffer({&lit_[i]}, nullptr, "lit part of the sunlight");
  }
}

void March::average_rows() {
  lit_target_[1].bind();
  blur_.use();
  blur_.set("lit_and_distance", 0);
  lit_[0].bind(0);
  gl::draw_full_screen(no_vertices_);
}

const ShaftPicture& March::draw(const ShaftInputs& inputs) {
  const glm::ivec2 size_px = shaft_size(inputs.view, divisor_);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  casters_.update(inputs);
  if (casters_.empty()) return shade_.draw(inputs, size_px, nullptr);
  make_targets(size_px);
  confine_to(shaft_region(inputs, size_px, kTilePx));  // the averages of the pixels that are shown reach past them
  lit_target_[0].bind();
  const gl::Program& march = program(inputs);
  march.use();
  set_ray(march, inputs, size_px);
  march.set("steps", steps_);
  march.set("least_step_m", least_step_m(*inputs.scene.medium, steps_));
  march.set("map_from_local", glm::mat4(casters_.map_from_world() * glm::inverse(inputs.view.local_from_world())));
  march.set("caster_depth", kMapUnit);
  casters_.texture().bind(kMapUnit);
  gl::draw_full_screen(no_vertices_);
  average_rows();
  return shade_.draw(inputs, size_px, &lit_[1]);
}

}  // namespace render
