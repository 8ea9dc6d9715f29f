#include "render/gl/read_back.h"

#include <cstddef>

#include "render/gl/error.h"

namespace render::gl {

std::vector<float> read_red(GLuint texture, int width, int height) {
  GLuint framebuffer = 0;
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  // What every driver reads from a float target is all four channels.
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<float> rgba(4 * pixels);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, rgba.data());
  glDeleteFramebuffers(1, &framebuffer);
  check_errors("read a texture back");
  std::vector<float> red(pixels);
  for (std::size_t i = 0; i < pixels; ++i) red[i] = rgba[4 * i];
  return red;
}

}  // namespace render::gl
