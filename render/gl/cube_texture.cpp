#include "render/gl/cube_texture.h"

#include <fmt/format.h>

#include "render/gl/error.h"
#include "render/gl/label.h"

namespace render::gl {

CubeTexture::CubeTexture(GLenum internal_format, int size, int levels, std::string_view name)
    : size_(size), levels_(levels) {
  glGenTextures(1, &id_);
  glActiveTexture(kUploadUnit);
  glBindTexture(GL_TEXTURE_CUBE_MAP, id_);
  glTexStorage2D(GL_TEXTURE_CUBE_MAP, levels, internal_format, size, size);
  glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  if (!name.empty()) label(LabelKind::Texture, id_, name);
  check_errors(fmt::format("cube texture {} of {} pixels, {} levels", name, size, levels));
}

CubeTexture& CubeTexture::operator=(CubeTexture&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(size_, other.size_);
  std::swap(levels_, other.levels_);
  return *this;
}

void CubeTexture::upload(int face, int level, GLenum format, GLenum type, const void* pixels) {
  glActiveTexture(kUploadUnit);
  glBindTexture(GL_TEXTURE_CUBE_MAP, id_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), level, 0, 0, size_ >> level,
                  size_ >> level, format, type, pixels);
}

}  // namespace render::gl
