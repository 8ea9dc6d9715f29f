#include "render/gl/texture.h"

#include <fmt/format.h>

#include <bit>
#include <stdexcept>

#include "render/gl/error.h"
#include "render/gl/label.h"

namespace render::gl {
namespace {

int channels_of(GLenum format) {
  switch (format) {
    case GL_RED:
    case GL_RED_INTEGER:
    case GL_DEPTH_COMPONENT:
      return 1;
    case GL_RG:
    case GL_RG_INTEGER:
      return 2;
    case GL_RGB:
    case GL_RGB_INTEGER:
      return 3;
    case GL_RGBA:
    case GL_RGBA_INTEGER:
      return 4;
    default:
      throw std::logic_error(fmt::format("bytes_per_pixel: unknown format 0x{:04x}", format));
  }
}

int bytes_of(GLenum type) {
  switch (type) {
    case GL_UNSIGNED_BYTE:
    case GL_BYTE:
      return 1;
    case GL_UNSIGNED_SHORT:
    case GL_SHORT:
    case GL_HALF_FLOAT:
      return 2;
    case GL_UNSIGNED_INT:
    case GL_INT:
    case GL_FLOAT:
      return 4;
    default:
      throw std::logic_error(fmt::format("bytes_per_pixel: unknown type 0x{:04x}", type));
  }
}

void bind_for_upload(GLuint texture) {
  glActiveTexture(kUploadUnit);
  glBindTexture(GL_TEXTURE_2D, texture);
}

}  // namespace

int bytes_per_pixel(GLenum format, GLenum type) {
  return channels_of(format) * bytes_of(type);
}

Texture::Texture(GLenum internal_format, int width, int height, Filter filter, int levels, std::string_view name)
    : format_(internal_format), width_(width), height_(height) {
  if (width <= 0 || height <= 0) throw std::logic_error(fmt::format("texture of {} x {} pixels", width, height));
  if (levels == 0) levels = static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(width, height))));
  glGenTextures(1, &id_);
  bind_for_upload(id_);
  glTexStorage2D(GL_TEXTURE_2D, levels, internal_format, width, height);
  set_wrap(GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
  set_filter(filter);
  if (!name.empty()) label(LabelKind::Texture, id_, name);
  check_errors(fmt::format("texture {} of {} x {} pixels", name, width, height));
}

Texture& Texture::operator=(Texture&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(format_, other.format_);
  std::swap(width_, other.width_);
  std::swap(height_, other.height_);
  return *this;
}

void Texture::upload(int x, int y, int width, int height, GLenum format, GLenum type, const void* pixels,
                     std::ptrdiff_t row_bytes) {
  const int pixel_bytes = bytes_per_pixel(format, type);
  if (row_bytes % pixel_bytes != 0) {
    throw std::logic_error(fmt::format("texture upload: a row of {} bytes holds no whole number of pixels of {} bytes",
                                       row_bytes, pixel_bytes));
  }
  bind_for_upload(id_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(row_bytes / pixel_bytes));
  glTexSubImage2D(GL_TEXTURE_2D, 0, x, y, width, height, format, type, pixels);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

void Texture::generate_mipmaps() {
  bind_for_upload(id_);
  glGenerateMipmap(GL_TEXTURE_2D);
}

void Texture::set_filter(Filter filter) {
  const GLint magnify = filter == Filter::Nearest ? GL_NEAREST : GL_LINEAR;
  const GLint minify = filter == Filter::Mipmap ? GL_LINEAR_MIPMAP_LINEAR : magnify;
  bind_for_upload(id_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minify);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, magnify);
}

void Texture::set_wrap(GLenum wrap_s, GLenum wrap_t) {
  bind_for_upload(id_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, static_cast<GLint>(wrap_s));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, static_cast<GLint>(wrap_t));
}

void Texture::set_depth_compare() {
  set_filter(Filter::Linear);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
}

}  // namespace render::gl
