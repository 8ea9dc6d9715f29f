#pragma once

#include <GLES3/gl31.h>

#include <string_view>
#include <utility>

#include "render/gl/texture.h"

namespace render::gl {

// An immutable-storage cube map, sampled linearly within and between its levels. Move-only.
class CubeTexture {
 public:
  CubeTexture() = default;
  // Faces of `size` pixels; level i is half as large as level i - 1.
  CubeTexture(GLenum internal_format, int size, int levels, std::string_view name = {});
  CubeTexture(CubeTexture&& other) noexcept { *this = std::move(other); }
  CubeTexture& operator=(CubeTexture&& other) noexcept;
  ~CubeTexture() { glDeleteTextures(1, &id_); }

  // Replaces a whole face of a level, in packed rows. `face` 0 to 5: +x -x +y -y +z -z.
  void upload(int face, int level, GLenum format, GLenum type, const void* pixels);

  TextureHandle handle() const { return {GL_TEXTURE_CUBE_MAP, id_}; }
  int size() const { return size_; }
  int levels() const { return levels_; }

 private:
  GLuint id_ = 0;
  int size_ = 0;
  int levels_ = 0;
};

}  // namespace render::gl
