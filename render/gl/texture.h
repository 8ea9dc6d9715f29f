#pragma once

#include <GLES3/gl31.h>

#include <cstddef>
#include <string_view>
#include <utility>

namespace render::gl {

enum class Filter { Nearest, Linear, Mipmap };  // Mipmap: trilinear, levels made by generate_mipmaps()

// A texture of any kind, borrowed.
struct TextureHandle {
  GLenum target = GL_TEXTURE_2D;
  GLuint id = 0;
};

// Creating and filling textures goes through a unit that no program reads, so that it disturbs no binding.
inline constexpr GLenum kUploadUnit = GL_TEXTURE0 + 31;

// An immutable-storage 2D texture. Move-only. Row 0 is the picture's top row, at v = 0.
class Texture {
 public:
  Texture() = default;
  // `levels` 0: a full mipmap chain. Wraps by clamping to the edge.
  Texture(GLenum internal_format, int width, int height, Filter filter = Filter::Nearest, int levels = 1,
          std::string_view name = {});
  Texture(Texture&& other) noexcept { *this = std::move(other); }
  Texture& operator=(Texture&& other) noexcept;
  ~Texture() { glDeleteTextures(1, &id_); }

  // Replaces the rectangle. `row_bytes` 0: rows are packed. Else a multiple of a pixel's bytes.
  void upload(int x, int y, int width, int height, GLenum format, GLenum type, const void* pixels,
              std::ptrdiff_t row_bytes = 0);
  void upload(GLenum format, GLenum type, const void* pixels) { upload(0, 0, width_, height_, format, type, pixels); }
  void generate_mipmaps();
  void set_filter(Filter filter);
  void set_wrap(GLenum wrap_s, GLenum wrap_t);
  // For sampler2DShadow: linear filtering of the comparison reference <= texel.
  void set_depth_compare();

  TextureHandle handle() const { return {GL_TEXTURE_2D, id_}; }
  GLuint id() const { return id_; }
  int width() const { return width_; }
  int height() const { return height_; }
  GLenum internal_format() const { return format_; }
  explicit operator bool() const { return id_ != 0; }

 private:
  GLuint id_ = 0;
  GLenum format_ = 0;
  int width_ = 0;
  int height_ = 0;
};

// Bytes of one pixel of that transfer format and type, as glTexSubImage2D counts them.
int bytes_per_pixel(GLenum format, GLenum type);

}  // namespace render::gl
