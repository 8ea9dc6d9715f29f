#pragma once

#include <map>

#include "render/composite/layers.h"
#include "render/gl/buffer.h"
#include "render/gl/framebuffer.h"
#include "render/images/image_io.h"

namespace render {

// Lays A, M, T and L over a linear background and gives the result as linear light, in 32-bit floats where the driver
// can render to them (else 16-bit).
class StillPass {
 public:
  // luminance_rgb in cd/m2, not exposed.
  void set_background(const LinearImage& background);
  void draw(const CompositeLayers& layers, double exposure);
  // Waits for the GL.
  LinearImage read() const;

 private:
  const gl::Program& program(const LayersVariant& variant);

  gl::Texture background_;
  gl::Texture result_;
  gl::Framebuffer framebuffer_;
  std::map<LayersVariant, gl::Program> programs_;
  gl::VertexArray no_vertices_;
};

}  // namespace render
