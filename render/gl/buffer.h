#pragma once

#include <GLES3/gl31.h>

#include <cstddef>
#include <span>
#include <utility>

namespace render::gl {

// Memory of the GL: vertices, indices, uniforms or read-back. Move-only.
class Buffer {
 public:
  Buffer() = default;
  Buffer(std::size_t bytes, const void* data, GLenum usage = GL_STATIC_DRAW);
  template <typename T>
  explicit Buffer(std::span<const T> items, GLenum usage = GL_STATIC_DRAW)
      : Buffer(items.size_bytes(), items.data(), usage) {}
  Buffer(Buffer&& other) noexcept { *this = std::move(other); }
  Buffer& operator=(Buffer&& other) noexcept;
  ~Buffer() { glDeleteBuffers(1, &id_); }

  void update(std::size_t offset_bytes, std::size_t bytes, const void* data);
  GLuint id() const { return id_; }
  explicit operator bool() const { return id_ != 0; }

 private:
  GLuint id_ = 0;
};

// How vertices lie in buffers. Move-only; borrows the buffers. Without attributes it serves shaders that make their
// vertices from gl_VertexID.
class VertexArray {
 public:
  VertexArray();
  VertexArray(VertexArray&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  VertexArray& operator=(VertexArray&& other) noexcept;
  ~VertexArray() { glDeleteVertexArrays(1, &id_); }

  // Attribute `location` is `components` values of `type` (GL_FLOAT, ...), `stride_bytes` apart.
  void attribute(GLuint location, const Buffer& buffer, int components, GLenum type, bool normalized,
                 std::size_t stride_bytes, std::size_t offset_bytes);
  void indices(const Buffer& buffer);
  void bind() const { glBindVertexArray(id_); }

 private:
  GLuint id_ = 0;
};

// Draws one triangle that covers the viewport, by shaders/lib/full_screen.vert. Needs no buffer.
void draw_full_screen(const VertexArray& empty);

}  // namespace render::gl
