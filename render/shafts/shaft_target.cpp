#include "render/shafts/shaft_target.h"

#include <array>

namespace render {

glm::ivec2 shaft_size(const View& view, int divisor) {
  return {(view.width + divisor - 1) / divisor, (view.height + divisor - 1) / divisor};
}

glm::ivec4 shaft_region(const ShaftInputs& inputs, const glm::ivec2& size_px, int margin_px) {
  const glm::ivec4 region = inputs.region_px;
  if (region.z <= 0 || region.w <= 0) return {0, 0, size_px.x, size_px.y};
  const glm::dvec2 ratio = glm::dvec2(size_px) / glm::dvec2(inputs.view.width, inputs.view.height);
  const glm::ivec2 margin(margin_px + 1);
  const glm::ivec2 low = glm::ivec2(glm::floor(ratio * glm::dvec2(region.x, region.y))) - margin;
  const glm::ivec2 high = glm::ivec2(glm::ceil(ratio * glm::dvec2(region.x + region.z, region.y + region.w))) + margin;
  const glm::ivec2 from = glm::clamp(low, glm::ivec2(0), size_px);
  const glm::ivec2 to = glm::clamp(high, glm::ivec2(0), size_px);
  return {from, to - from};
}

void confine_to(const glm::ivec4& region_px) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(region_px.x, region_px.y, region_px.z, region_px.w);
}

void draw_row_groups(const gl::VertexArray& no_vertices, int rows) {
  constexpr int kRows = 64;
  no_vertices.bind();
  glDrawArrays(GL_TRIANGLES, 0, 6 * ((rows + kRows - 1) / kRows));
}

void plain_state() {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
}

void add_up(std::size_t part) {
  if (part == 0) return;
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE);
}

void ShaftTarget::begin(const ShaftInputs& inputs, const glm::ivec2& size_px) {
  const bool with_distance = inputs.with_distance || size_px != glm::ivec2(inputs.view.width, inputs.view.height);
  if (picture_.width != size_px.x || picture_.height != size_px.y || (picture_.distance != 0) != with_distance) {
    scattered_ = gl::Texture(GL_RGBA16F, size_px.x, size_px.y, gl::Filter::Linear, 1, "shafts");
    distance_ = with_distance ? gl::Texture(GL_R32F, size_px.x, size_px.y, gl::Filter::Nearest, 1, "shaft distance")
                              : gl::Texture();
    if (with_depth_)
      depth_ = gl::Texture(GL_DEPTH_COMPONENT16, size_px.x, size_px.y, gl::Filter::Nearest, 1, "shafts left");
    const gl::Texture* depth = with_depth_ ? &depth_ : nullptr;
    framebuffer_ = with_distance ? gl::Framebuffer({&scattered_, &distance_}, depth, "shafts")
                                 : gl::Framebuffer({&scattered_}, depth, "shafts");
    picture_ = {.texture = scattered_.id(), .distance = distance_.id(), .width = size_px.x, .height = size_px.y};
  }
  framebuffer_.bind();
  plain_state();
  if (with_depth_) {
    const float farthest = 1.0F;
    glDepthMask(GL_TRUE);
    glClearBufferfv(GL_DEPTH, 0, &farthest);
  }
  const glm::ivec4 region = shaft_region(inputs, size_px, 0);
  if (region == glm::ivec4(0, 0, size_px.x, size_px.y)) return;
  const std::array<float, 4> nothing{0.0F, 0.0F, 0.0F, 1.0F};
  const std::array<float, 4> far_away{1e9F, 0.0F, 0.0F, 0.0F};
  glClearBufferfv(GL_COLOR, 0, nothing.data());
  if (with_distance) glClearBufferfv(GL_COLOR, 1, far_away.data());
  confine_to(region);
}

}  // namespace render
