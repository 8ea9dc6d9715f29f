#include "render/shafts/march.h"

namespace render {
namespace {

constexpr int kVirtualMapUnit = 8;  // and 9
constexpr int kRealMapUnit = 10;    // and 11

bool casts(const ShaftInputs& inputs, Casters kind) {
  return !inputs.shadow.map(kind).fit.empty;
}

}  // namespace

const gl::Program& March::program(const ShaftInputs& inputs) {
  const bool bounded = inputs.scene.medium->extent.has_value();
  const int key = (bounded ? 1 : 0) + (casts(inputs, Casters::Virtual) ? 2 : 0) +
                  (casts(inputs, Casters::Real) ? 4 : 0) + (inputs.depth != 0 ? 8 : 0);
  auto found = programs_.find(key);
  if (found == programs_.end()) {
    gl::Defines defines;
    if (bounded) defines.push_back({"BOUNDED"});
    if (casts(inputs, Casters::Virtual)) defines.push_back({"VIRTUAL_CASTERS"});
    if (casts(inputs, Casters::Real)) defines.push_back({"REAL_CASTERS"});
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
  make_targets(size_px);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  lit_target_[0].bind();
  const gl::Program& march = program(inputs);
  march.use();
  set_ray(march, inputs, size_px);
  march.set("steps", steps_);
  inputs.shadow.bind(Casters::Virtual, inputs.view, march, kVirtualMapUnit);
  inputs.shadow.bind(Casters::Real, inputs.view, march, kRealMapUnit);
  gl::draw_full_screen(no_vertices_);
  SunShadow::unbind(kVirtualMapUnit);
  SunShadow::unbind(kRealMapUnit);
  average_rows();
  return shade_.draw(inputs, size_px, &lit_[1]);
}

}  // namespace render
