#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "render/composite/layers.h"
#include "render/gl/buffer.h"
#include "render/gl/framebuffer.h"

namespace render {

// A pixel of all that is laid over the real picture: real * keep + add.
struct MergedPixel {
  std::array<std::uint8_t, 4> keep{255, 255, 255, 255};  // 255: all of it
  std::array<std::uint8_t, 4> add{0, 0, 0, 255};  // 255 * sqrt(display-linear light / kMergedWhite); [3]: nothing
};
inline constexpr float kMergedWhite = 3.0F;  // twice shoulder.glsl's kShoulderWhite

struct MergedPicture {
  int width = 0;
  int height = 0;
  std::vector<MergedPixel> pixels;  // row 0 at the top
};

// Makes one layer of objects and medium, of the ideal picture's size, and brings it to the CPU.
class MergePass {
 public:
  // Only the pixels of `region` hold anything. The lens of `layers` is left to whoever uses the picture.
  void draw(const CompositeLayers& layers, const PixelRect& region, bool wide_gamut);
  // Waits for the GL. Valid until the next call.
  const MergedPicture& read();

 private:
  const gl::Program& program(const LayersVariant& variant, bool wide_gamut);

  std::array<gl::Texture, 2> targets_;
  gl::Framebuffer framebuffer_;
  std::map<std::pair<LayersVariant, bool>, gl::Program> programs_;
  gl::VertexArray no_vertices_;
  PixelRect region_;
  std::array<std::vector<std::uint8_t>, 2> packed_;
  MergedPicture picture_;
};

}  // namespace render
