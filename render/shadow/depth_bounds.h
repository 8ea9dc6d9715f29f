#pragma once

#include "render/gl/buffer.h"
#include "render/gl/framebuffer.h"
#include "render/gl/program.h"
#include "render/gl/texture.h"

namespace render {

// For every block of texels of a shadow map, the nearest and the farthest depth (RG32F) in it and some blocks around:
// where a receiver lies before or behind all of that, one look-up answers for a whole search disc, exactly.
class DepthBounds {
 public:
  // From that map (bound with a sampler that does not compare on unit 0), around each block for at least `reach_texels`
  // (up to 32) of the map. Changes framebuffer, viewport, program and depth state.
  void update(const gl::Texture& map, const gl::VertexArray& no_vertices, double reach_texels);

  const gl::Texture& texture() const { return around_; }
  // Half the side of the window that one texel answers for around any point of its block, in texels of the map.
  float reach_texels() const { return static_cast<float>(kBlock * reach_); }

 private:
  static constexpr int kBlock = 4;

  gl::Program block_program_{"lib/full_screen.vert", "shadow/bounds.frag", {{"BLOCK", "4"}}};
  gl::Program reach_program_{"lib/full_screen.vert", "shadow/bounds.frag"};
  gl::Texture around_;
  gl::Texture along_;
  gl::Framebuffer to_around_;
  gl::Framebuffer to_along_;
  int reach_ = 0;  // blocks
};

}  // namespace render
