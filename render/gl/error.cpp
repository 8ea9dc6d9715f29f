#include "render/gl/error.h"

#include <GLES3/gl31.h>
#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace render::gl {
namespace {

std::string error_name(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    default:
      return fmt::format("GL error 0x{:04x}", error);
  }
}

}  // namespace

void check_errors(std::string_view where) {
  // A lost context reports errors for ever: a handful says enough.
  constexpr int kMostErrors = 8;
  std::string all;
  for (int i = 0; i < kMostErrors; ++i) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) break;
    all += (all.empty() ? "" : ", ") + error_name(error);
  }
  if (!all.empty()) throw std::runtime_error(fmt::format("{}: {}", where, all));
}

}  // namespace render::gl
