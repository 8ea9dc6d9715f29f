#pragma once

#include "render/gl/buffer.h"
#include "render/gl/framebuffer.h"
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

// Draws rows of the viewport 64 at a time, as wide as the program in use finds them (epipolar_samples.vert,
// slice_cells.vert).
void draw_row_groups(const gl::VertexArray& no_vertices, int rows);

// The state that all passes of the techniques draw in: no depth test, no blending, no scissor.
void plain_state();
// Of several parts of the medium, what is drawn next is that one's: added to what the first has left. plain_state()
// ends it.
void add_up(std::size_t part);

// Where a technique's last pass draws: light and transmittance, and the distance along the axis (as shading.frag).
class ShaftTarget {
 public:
  // With a depth buffer, by which a later draw can be kept to the pixels that an earlier one has left.
  explicit ShaftTarget(bool with_depth = false) : with_depth_(with_depth) {}

  // Bound, confined to the view's region, and empty elsewhere; depth, if any, at its farthest.
  void begin(const ShaftInputs& inputs, const glm::ivec2& size_px);
  const ShaftPicture& picture() const { return picture_; }

 private:
  bool with_depth_;
  gl::Texture scattered_;
  gl::Texture distance_;
  gl::Texture depth_;
  gl::Framebuffer framebuffer_;
  ShaftPicture picture_;
};

}  // namespace render
