#pragma once

#include <GLES3/gl31.h>

#include <initializer_list>
#include <string_view>
#include <utility>

#include "render/gl/layered_texture.h"
#include "render/gl/texture.h"

namespace render::gl {

// Storage that is drawn to and resolved, never sampled. Move-only. samples 0: not multisampled; else the driver's
// nearest count not below it, at most its maximum.
class Renderbuffer {
 public:
  Renderbuffer() = default;
  Renderbuffer(GLenum internal_format, int width, int height, int samples = 0);
  Renderbuffer(Renderbuffer&& other) noexcept { *this = std::move(other); }
  Renderbuffer& operator=(Renderbuffer&& other) noexcept;
  ~Renderbuffer() { glDeleteRenderbuffers(1, &id_); }

  GLuint id() const { return id_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  GLuint id_ = 0;
  int width_ = 0;
  int height_ = 0;
};

// A render target. Move-only; borrows what is attached, which must outlive it. Row 0 of the picture is row 0 of the
// framebuffer: a projection for it has y growing downwards.
class Framebuffer {
 public:
  Framebuffer() = default;
  // `depth` null: none. Throws std::runtime_error that names `name` where the driver refuses the combination.
  Framebuffer(std::initializer_list<const Texture*> colors, const Texture* depth, std::string_view name);
  Framebuffer(std::initializer_list<const Renderbuffer*> colors, const Renderbuffer* depth, std::string_view name);
  // One layer as the only colour, or as the depth where that is its format.
  Framebuffer(const LayeredTexture& texture, int layer, std::string_view name);
  Framebuffer(Framebuffer&& other) noexcept { *this = std::move(other); }
  Framebuffer& operator=(Framebuffer&& other) noexcept;
  ~Framebuffer() { glDeleteFramebuffers(1, &id_); }

  // Draws go here from now on, into the whole of it (viewport set).
  void bind() const;
  GLuint id() const { return id_; }
  int width() const { return width_; }
  int height() const { return height_; }
  explicit operator bool() const { return id_ != 0; }

 private:
  void finish(int color_count, std::string_view name);

  GLuint id_ = 0;
  int width_ = 0;
  int height_ = 0;
};

// Copies (resolves where `from` is multisampled) the rectangle of one colour attachment. Formats must agree.
// Afterwards `from` draws and reads from attachment 0 and all its draw buffers are as they were.
void blit_color(const Framebuffer& from, int from_attachment, const Framebuffer& to, int x, int y, int width,
                int height);

}  // namespace render::gl
