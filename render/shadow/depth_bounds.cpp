#include "render/shadow/depth_bounds.h"

#include <algorithm>
#include <cmath>

namespace render {

void DepthBounds::update(const gl::Texture& map, const gl::VertexArray& no_vertices, double reach_texels) {
  const int size = (map.width() + kBlock - 1) / kBlock;
  if (around_.width() != size) {
    around_ = gl::Texture(GL_RG32F, size, size, gl::Filter::Nearest, 1, "shadow bounds");
    along_ = gl::Texture(GL_RG32F, size, size, gl::Filter::Nearest, 1, "shadow bounds along a row");
    to_around_ = gl::Framebuffer({&around_}, nullptr, "shadow bounds");
    to_along_ = gl::Framebuffer({&along_}, nullptr, "shadow bounds along a row");
  }
  reach_ = static_cast<int>(std::clamp(std::ceil(reach_texels / kBlock), 1.0, 8.0));
  glDisable(GL_DEPTH_TEST);
  const auto draw = [&](const gl::Framebuffer& to, const gl::Program& program, const gl::Texture& from) {
    to.bind();
    program.use();
    program.set("source", 0);
    from.bind(0);
    gl::draw_full_screen(no_vertices);
  };
  draw(to_around_, block_program_, map);
  reach_program_.set("reach", reach_);
  reach_program_.set("direction", glm::ivec2(1, 0));
  draw(to_along_, reach_program_, around_);
  reach_program_.set("direction", glm::ivec2(0, 1));
  draw(to_around_, reach_program_, along_);
}

}  // namespace render
