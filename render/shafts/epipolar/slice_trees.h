#pragma once

#include "render/gl/buffer.h"
#include "render/gl/framebuffer.h"
#include "render/gl/program.h"
#include "render/shafts/epipolar/line_layout.h"
#include "render/shafts/medium_program.h"
#include "render/shafts/occluder_map.h"

namespace render {

// One-dimensional min-max trees over the occluders along each epipolar slice (Chen et al. 2011; Tan 2020's form,
// without rectification: slices are straight lines across the shadow map itself).
class SliceTrees {
 public:
  // Changes framebuffer, viewport and program. Uses texture units 0, 1 and 8.
  void update(const ShaftInputs& inputs, const OccluderMap& occluders, const LineLayout& layout);

  // To three texture units from that one on, with all that shaders/shafts/minmax_traverse.glsl needs.
  void bind(const gl::Program& program) const;

 private:
  void make_storage(const OccluderMap& occluders, int rows);
  // Where each slice (the plane through the eye, the sun and a line) runs across the map: direction with its larger
  // part +-1, where the first cell begins along it, in texels from the eye, and how many cells there are. A cell is one
  // texel of the axis that the slice is nearer to.
  void lay_slices(const ShaftInputs& inputs, const OccluderMap& occluders, const LineLayout& layout);
  void draw_leaves(const OccluderMap& occluders);
  void draw_levels();
  void draw_cells(const gl::Framebuffer& target, const gl::Program& program, int pixels_a_block) const;

  int rows_ = 0;
  int cells_ = 0;  // that there is room for: a multiple of a node of the highest level
  int top_level_ = 0;
  glm::ivec4 level_first_{0};
  glm::dmat4 texels_from_local_{1.0};
  gl::Program leaves_program_{"shafts/slice_cells.vert", "shafts/minmax_leaves.frag"};
  gl::Program blocks_program_{"shafts/slice_cells.vert", "shafts/minmax_blocks.frag"};
  gl::Program levels_program_{"lib/full_screen.vert", "shafts/minmax_levels.frag"};
  gl::Texture slices_;
  gl::Texture leaves_;
  gl::Texture blocks_;
  gl::Texture levels_;
  gl::Framebuffer to_leaves_;
  gl::Framebuffer to_blocks_;
  gl::Framebuffer to_levels_;
  gl::VertexArray no_vertices_;
};

}  // namespace render
