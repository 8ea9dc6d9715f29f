#include "render/composite/still_pass.h"

#include "render/gl/error.h"
#include "render/gl/extensions.h"

namespace render {

void StillPass::set_background(const LinearImage& background) {
  if (background_.width() != background.width || background_.height() != background.height) {
    const bool floats = gl::extensions().color_buffer_float;
    background_ = gl::Texture(GL_RGB32F, background.width, background.height, gl::Filter::Nearest, 1, "background");
    result_ = gl::Texture(floats ? GL_RGBA32F : GL_RGBA16F, background.width, background.height, gl::Filter::Nearest, 1,
                          "linear still");
    framebuffer_ = gl::Framebuffer({&result_}, nullptr, "linear still");
  }
  background_.upload(GL_RGB, GL_FLOAT, background.rgb.data());
}

const gl::Program& StillPass::program(const LayersVariant& variant) {
  auto found = programs_.find(variant);
  if (found == programs_.end()) {
    gl::Defines defines;
    variant.add_defines(defines);
    found = programs_.emplace(variant, gl::Program("lib/full_screen.vert", "composite/still.frag", defines)).first;
  }
  return found->second;
}

void StillPass::draw(const CompositeLayers& layers, double exposure) {
  const gl::Program& still = program(layers.variant());
  framebuffer_.bind();
  still.use();
  still.bind("background", background_.handle());
  still.set("exposure", static_cast<float>(exposure));
  bind_layers(layers, still);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  gl::draw_full_screen(no_vertices_);
  gl::check_errors("still");
}

LinearImage StillPass::read() const {
  LinearImage image{result_.width(), result_.height(), {}};
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  std::vector<glm::vec4> rgba(pixels);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.id());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, image.width, image.height, GL_RGBA, GL_FLOAT, rgba.data());
  gl::check_errors("read the still back");
  image.rgb.assign(rgba.begin(), rgba.end());
  return image;
}

}  // namespace render
