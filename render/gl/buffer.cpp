#include "render/gl/buffer.h"

#include "render/gl/error.h"

namespace render::gl {

Buffer::Buffer(std::size_t bytes, const void* data, GLenum usage) {
  glGenBuffers(1, &id_);
  // GL_COPY_WRITE_BUFFER leaves vertex arrays and their index binding alone.
  glBindBuffer(GL_COPY_WRITE_BUFFER, id_);
  glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes), data, usage);
  check_errors("buffer");
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(id_, other.id_);
  return *this;
}

void Buffer::update(std::size_t offset_bytes, std::size_t bytes, const void* data) {
  glBindBuffer(GL_COPY_WRITE_BUFFER, id_);
  glBufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(offset_bytes), static_cast<GLsizeiptr>(bytes), data);
}

VertexArray::VertexArray() {
  glGenVertexArrays(1, &id_);
}

VertexArray& VertexArray::operator=(VertexArray&& other) noexcept {
  std::swap(id_, other.id_);
  return *this;
}

void VertexArray::attribute(GLuint location, const Buffer& buffer, int components, GLenum type, bool normalized,
                            std::size_t stride_bytes, std::size_t offset_bytes) {
  glBindVertexArray(id_);
  glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, components, type, normalized ? GL_TRUE : GL_FALSE, static_cast<GLsizei>(stride_bytes),
                        reinterpret_cast<const void*>(offset_bytes));
}

void VertexArray::indices(const Buffer& buffer) {
  glBindVertexArray(id_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer.id());
}

void draw_full_screen(const VertexArray& empty) {
  empty.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace render::gl
