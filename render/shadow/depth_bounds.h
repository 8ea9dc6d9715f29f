#pragma once

#include <array>

#include "render/gl/buffer.h"
#include "render/gl/framebuffer.h"
#include "render/gl/layered_texture.h"
#include "render/gl/program.h"

namespace render {

// For every block of texels of shadow maps, the nearest and the farthest depth (RG32F) in it and some blocks around:
// where a receiver lies before or behind all of that, one look-up answers for a whole search disc, exactly.
class DepthBounds {
 public:
  static constexpr int kMostLayers = 2;

  // Of one layer of those maps, read by `plain`, around each block for at least `reach_texels` (up to 32) of the map.
  // Changes framebuffer, viewport, program and depth state.
  void update(const gl::LayeredTexture& maps, int layer, const gl::Sampler& plain, const gl::VertexArray& no_vertices,
              double reach_texels);

  // Layers as the maps have them.
  const gl::LayeredTexture& texture() const { return around_; }
  // Half the side of the window that one texel answers for around any point of its block, in texels of the map.
  float reach_texels(int layer) const {
    return static_cast<float>(kBlock * reach_.at(static_cast<std::size_t>(layer)));
  }

 private:
  static constexpr int kBlock = 4;

  void make_storage(const gl::LayeredTexture& maps);
  void draw(const gl::Framebuffer& to, const gl::Program& program, const gl::LayeredTexture& from, int layer,
            const gl::Sampler* sampler, const gl::VertexArray& no_vertices) const;

  gl::Program block_program_{"lib/full_screen.vert", "shadow/bounds.frag", {{"BLOCK", "4"}}};
  gl::Program reach_program_{"lib/full_screen.vert", "shadow/bounds.frag"};
  gl::LayeredTexture around_;
  gl::LayeredTexture along_;
  std::array<gl::Framebuffer, kMostLayers> to_around_;
  gl::Framebuffer to_along_;
  std::array<int, kMostLayers> reach_{};  // blocks
};

}  // namespace render
