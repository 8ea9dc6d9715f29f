#include "render/shadow/depth_bounds.h"

#include <algorithm>
#include <cmath>

namespace render {

void DepthBounds::make_storage(const gl::LayeredTexture& maps) {
  using gl::LayeredTexture;
  const int size = (maps.width() + kBlock - 1) / kBlock;
  if (around_.width() == size && around_.layers() == maps.layers()) return;
  constexpr auto kArray = LayeredTexture::Kind::Array;
  around_ = LayeredTexture(kArray, GL_RG32F, size, size, maps.layers(), gl::Filter::Nearest, "shadow bounds");
  along_ = LayeredTexture(kArray, GL_RG32F, size, size, 1, gl::Filter::Nearest, "shadow bounds along a row");
  for (int layer = 0; layer < maps.layers(); ++layer) {
    to_around_.at(static_cast<std::size_t>(layer)) = gl::Framebuffer(around_, layer, "shadow bounds");
  }
  to_along_ = gl::Framebuffer(along_, 0, "shadow bounds along a row");
}

void DepthBounds::draw(const gl::Framebuffer& to, const gl::Program& program, const gl::LayeredTexture& from, int layer,
                       const gl::Sampler* sampler, const gl::VertexArray& no_vertices) const {
  to.bind();
  program.use();
  program.bind("source", from.handle(), sampler);
  program.set("layer", layer);
  gl::draw_full_screen(no_vertices);
}

void DepthBounds::update(const gl::LayeredTexture& maps, int layer, const gl::Sampler& plain,
                         const gl::VertexArray& no_vertices, double reach_texels) {
  make_storage(maps);
  const int reach = static_cast<int>(std::clamp(std::ceil(reach_texels / kBlock), 1.0, 8.0));
  reach_.at(static_cast<std::size_t>(layer)) = reach;
  const gl::Framebuffer& to_around = to_around_.at(static_cast<std::size_t>(layer));
  glDisable(GL_DEPTH_TEST);
  draw(to_around, block_program_, maps, layer, &plain, no_vertices);
  reach_program_.set("reach", reach);
  reach_program_.set("direction", glm::ivec2(1, 0));
  draw(to_along_, reach_program_, around_, layer, nullptr, no_vertices);
  reach_program_.set("direction", glm::ivec2(0, 1));
  draw(to_around, reach_program_, along_, 0, nullptr, no_vertices);
}

}  // namespace render
