#pragma once

#include <GLES3/gl31.h>

#include <utility>

namespace render::gl {

// How a texture is read, in place of its own filters: the same depth map is read compared and plain. Move-only.
class Sampler {
 public:
  // Nearest texels, clamped to the edge, not compared.
  static Sampler plain();

  Sampler(Sampler&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Sampler& operator=(Sampler&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Sampler() { glDeleteSamplers(1, &id_); }

  GLuint id() const { return id_; }

 private:
  Sampler() { glGenSamplers(1, &id_); }

  GLuint id_ = 0;
};

}  // namespace render::gl
