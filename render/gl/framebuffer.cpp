#include "render/gl/framebuffer.h"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

#include "render/gl/error.h"
#include "render/gl/label.h"

namespace render::gl {
namespace {

GLenum depth_attachment(bool with_stencil) {
  return with_stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
}

bool has_stencil(GLenum internal_format) {
  return internal_format == GL_DEPTH24_STENCIL8 || internal_format == GL_DEPTH32F_STENCIL8;
}

bool is_depth(GLenum internal_format) {
  return internal_format == GL_DEPTH_COMPONENT16 || internal_format == GL_DEPTH_COMPONENT24 ||
         internal_format == GL_DEPTH_COMPONENT32F;
}

}  // namespace

Renderbuffer::Renderbuffer(GLenum internal_format, int width, int height, int samples)
    : width_(width), height_(height) {
  glGenRenderbuffers(1, &id_);
  glBindRenderbuffer(GL_RENDERBUFFER, id_);
  GLint most = 0;
  glGetInternalformativ(GL_RENDERBUFFER, internal_format, GL_SAMPLES, 1, &most);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, std::min(samples, most), internal_format, width, height);
  check_errors(fmt::format("renderbuffer of {} x {} pixels, {} samples", width, height, samples));
}

Renderbuffer& Renderbuffer::operator=(Renderbuffer&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(width_, other.width_);
  std::swap(height_, other.height_);
  return *this;
}

Framebuffer::Framebuffer(std::initializer_list<const Texture*> colors, const Texture* depth, std::string_view name) {
  const Texture* any = colors.size() > 0 ? *colors.begin() : depth;
  width_ = any->width();
  height_ = any->height();
  glGenFramebuffers(1, &id_);
  glBindFramebuffer(GL_FRAMEBUFFER, id_);
  GLenum attachment = GL_COLOR_ATTACHMENT0;
  for (const Texture* color : colors) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment++, GL_TEXTURE_2D, color->id(), 0);
  }
  if (depth != nullptr) {
    const GLenum where = depth_attachment(has_stencil(depth->internal_format()));
    glFramebufferTexture2D(GL_FRAMEBUFFER, where, GL_TEXTURE_2D, depth->id(), 0);
  }
  finish(static_cast<int>(colors.size()), name);
}

Framebuffer::Framebuffer(std::initializer_list<const Renderbuffer*> colors, const Renderbuffer* depth,
                         std::string_view name) {
  const Renderbuffer* any = colors.size() > 0 ? *colors.begin() : depth;
  width_ = any->width();
  height_ = any->height();
  glGenFramebuffers(1, &id_);
  glBindFramebuffer(GL_FRAMEBUFFER, id_);
  GLenum attachment = GL_COLOR_ATTACHMENT0;
  for (const Renderbuffer* color : colors) {
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment++, GL_RENDERBUFFER, color->id());
  }
  if (depth != nullptr) glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth->id());
  finish(static_cast<int>(colors.size()), name);
}

Framebuffer::Framebuffer(const LayeredTexture& texture, int layer, std::string_view name)
    : width_(texture.width()), height_(texture.height()) {
  glGenFramebuffers(1, &id_);
  glBindFramebuffer(GL_FRAMEBUFFER, id_);
  const bool depth = is_depth(texture.internal_format());
  glFramebufferTextureLayer(GL_FRAMEBUFFER, depth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0, texture.id(), 0, layer);
  finish(depth ? 0 : 1, name);
}

void Framebuffer::finish(int color_count, std::string_view name) {
  constexpr std::array<GLenum, 4> kBuffers{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2,
                                           GL_COLOR_ATTACHMENT3};
  constexpr GLenum kNone = GL_NONE;
  glDrawBuffers(color_count > 0 ? color_count : 1, color_count > 0 ? kBuffers.data() : &kNone);
  if (color_count == 0) glReadBuffer(GL_NONE);
  const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    glDeleteFramebuffers(1, &id_);
    id_ = 0;
    throw std::runtime_error(fmt::format("framebuffer {} is refused by the driver (0x{:04x})", name, status));
  }
  label(LabelKind::Framebuffer, id_, name);
}

Framebuffer& Framebuffer::operator=(Framebuffer&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(width_, other.width_);
  std::swap(height_, other.height_);
  return *this;
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, id_);
  glViewport(0, 0, width_, height_);
}

void blit_color(const Framebuffer& from, int from_attachment, const Framebuffer& to, int x, int y, int width,
                int height) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to.id());
  glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(from_attachment));
  glBlitFramebuffer(x, y, x + width, y + height, x, y, x + width, y + height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
}

}  // namespace render::gl
