#pragma once

#include <GLES3/gl31.h>

#include <string_view>
#include <utility>

#include "render/gl/texture.h"

namespace render::gl {

// An immutable-storage texture of several layers: an array of pictures (sampler2DArray), or a volume (sampler3D) whose
// layers are filtered into each other. One level, clamped to its edges. Move-only.
class LayeredTexture {
 public:
  enum class Kind { Array, Volume };

  LayeredTexture() = default;
  // Throws std::logic_error where a size is not positive, std::runtime_error where the driver refuses.
  LayeredTexture(Kind kind, GLenum internal_format, int width, int height, int layers, Filter filter = Filter::Nearest,
                 std::string_view name = {});
  LayeredTexture(LayeredTexture&& other) noexcept { *this = std::move(other); }
  LayeredTexture& operator=(LayeredTexture&& other) noexcept;
  ~LayeredTexture() { glDeleteTextures(1, &handle_.id); }

  // Replaces a whole layer, in packed rows.
  void upload(int layer, GLenum format, GLenum type, const void* pixels);
  // For sampler2DArrayShadow: linear filtering of the comparison reference <= texel.
  void set_depth_compare();

  TextureHandle handle() const { return handle_; }
  GLuint id() const { return handle_.id; }
  int width() const { return width_; }
  int height() const { return height_; }
  int layers() const { return layers_; }
  GLenum internal_format() const { return format_; }

 private:
  void bind_for_upload() const;

  TextureHandle handle_{GL_TEXTURE_2D_ARRAY, 0};
  GLenum format_ = 0;
  int width_ = 0;
  int height_ = 0;
  int layers_ = 0;
};

}  // namespace render::gl
