#pragma once

#include <map>

#include "render/gl/buffer.h"
#include "render/gl/framebuffer.h"
#include "render/gl/program.h"
#include "render/gl/texture.h"
#include "render/shafts/shaft_technique.h"

namespace render {

// Size of a shaft picture for a view, at 1/divisor of its width and height, rounded up.
glm::ivec2 shaft_size(const View& view, int divisor);

// The shaft picture's pixels that a technique computes (x, y, width, height), and `margin_px` more around them: those
// of inputs.region_px, and one more for upsampling.
glm::ivec4 shaft_region(const ShaftInputs& inputs, const glm::ivec2& size_px, int margin_px);

// Draws reach only that rectangle, until GL_SCISSOR_TEST is disabled.
void confine_to(const glm::ivec4& region_px);

// Sets what shaders/shafts/ray.glsl and view_depth.glsl need, and binds the depth texture to unit 0.
void set_ray(const gl::Program& program, const ShaftInputs& inputs, const glm::ivec2& size_px);

// The last step of every technique: closed forms of the scattered light and of the transmittance, the sun's part
// multiplied by what a technique found to be lit.
class ShadePass {
 public:
  // `lit_and_distance`: RG32F of that size: lit part of the sunlight, averaged along rows, and distance along the
  // axis. Null: all lit.
  const ShaftPicture& draw(const ShaftInputs& inputs, const glm::ivec2& size_px, const gl::Texture* lit_and_distance);

 private:
  const gl::Program& program(bool bounded, bool marched, bool has_depth);
  void make_targets(const glm::ivec2& size_px);

  std::map<int, gl::Program> programs_;
  gl::Texture scattered_;
  gl::Texture distance_;
  gl::Framebuffer framebuffer_;
  gl::VertexArray no_vertices_;
  ShaftPicture picture_;
};

}  // namespace render
