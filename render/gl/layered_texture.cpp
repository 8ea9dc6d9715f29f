#include "render/gl/layered_texture.h"

#include <fmt/format.h>

#include <stdexcept>

#include "render/gl/error.h"
#include "render/gl/label.h"

namespace render::gl {

LayeredTexture::LayeredTexture(Kind kind, GLenum internal_format, int width, int height, int layers, Filter filter,
                               std::string_view name)
    : handle_{kind == Kind::Array ? GLenum{GL_TEXTURE_2D_ARRAY} : GLenum{GL_TEXTURE_3D}, 0},
      format_(internal_format),
      width_(width),
      height_(height),
      layers_(layers) {
  if (width <= 0 || height <= 0 || layers <= 0) {
    throw std::logic_error(fmt::format("texture of {} x {} pixels, {} layers", width, height, layers));
  }
  glGenTextures(1, &handle_.id);
  bind_for_upload();
  glTexStorage3D(handle_.target, 1, internal_format, width, height, layers);
  const GLint how = filter == Filter::Nearest ? GL_NEAREST : GL_LINEAR;
  glTexParameteri(handle_.target, GL_TEXTURE_MIN_FILTER, how);
  glTexParameteri(handle_.target, GL_TEXTURE_MAG_FILTER, how);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
    glTexParameteri(handle_.target, axis, GL_CLAMP_TO_EDGE);
  }
  if (!name.empty()) label(LabelKind::Texture, handle_.id, name);
  check_errors(fmt::format("texture {} of {} x {} pixels, {} layers", name, width, height, layers));
}

LayeredTexture& LayeredTexture::operator=(LayeredTexture&& other) noexcept {
  std::swap(handle_, other.handle_);
  std::swap(format_, other.format_);
  std::swap(width_, other.width_);
  std::swap(height_, other.height_);
  std::swap(layers_, other.layers_);
  return *this;
}

void LayeredTexture::bind_for_upload() const {
  glActiveTexture(kUploadUnit);
  glBindTexture(handle_.target, handle_.id);
}

void LayeredTexture::upload(int layer, GLenum format, GLenum type, const void* pixels) {
  bind_for_upload();
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage3D(handle_.target, 0, 0, 0, layer, width_, height_, 1, format, type, pixels);
}

void LayeredTexture::set_depth_compare() {
  bind_for_upload();
  glTexParameteri(handle_.target, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(handle_.target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(handle_.target, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(handle_.target, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
}

}  // namespace render::gl
