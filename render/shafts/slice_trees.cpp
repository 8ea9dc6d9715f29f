#include "render/shafts/slice_trees.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "render/shafts/shaft_target.h"

namespace render {
namespace {

constexpr int kMapUnit = 8;
constexpr int kLargestNode = 1024;       // cells; the smallest has 16, each level four times as many as the one below
constexpr double kDepthSteps = 65534.0;  // leaves.frag keeps depth in 16 bits

}  // namespace

void SliceTrees::make_storage(const CasterMap& casters, int rows) {
  const glm::ivec2 size = casters.size_px();
  const int cells = (std::max(size.x, size.y) + kLargestNode - 1) / kLargestNode * kLargestNode;
  rows_ = rows;
  if (cells == cells_ && slices_.height() >= rows) return;
  cells_ = cells;
  level_first_ = {0, cells / 16, cells / 16 + cells / 64, cells / 16 + cells / 64 + cells / 256};
  slices_ = gl::Texture(GL_RGBA32F, 1, rows, gl::Filter::Nearest, 1, "epipolar slices");
  leaves_ = gl::Texture(GL_RGBA16UI, cells / 4, rows, gl::Filter::Nearest, 1, "casters of slices");
  blocks_ = gl::Texture(GL_RG16UI, cells / 16, rows, gl::Filter::Nearest, 1, "bounds of 16 cells");
  nodes_ = gl::Texture(GL_RG16UI, level_first_.w + cells / 1024, rows, gl::Filter::Nearest, 1, "min-max trees");
  to_slices_ = gl::Framebuffer({&slices_}, nullptr, "epipolar slices");
  to_leaves_ = gl::Framebuffer({&leaves_}, nullptr, "casters of slices");
  to_blocks_ = gl::Framebuffer({&blocks_}, nullptr, "bounds of 16 cells");
  to_nodes_ = gl::Framebuffer({&nodes_}, nullptr, "min-max trees");
}

void SliceTrees::draw_into(const gl::Framebuffer& target) const {
  target.bind();
  confine_to({0, 0, target.width(), rows_});
  gl::draw_full_screen(no_vertices_);
}

void SliceTrees::draw_slices(const ShaftInputs& inputs, const CasterMap& casters, const LineLayout& layout) {
  const glm::dvec3 steps(casters.size_px(), kDepthSteps);
  texels_from_local_ =
      glm::scale(glm::dmat4(1.0), steps) * casters.map_from_world() * glm::inverse(inputs.view.local_from_world());
  slice_program_.use();
  slice_program_.set("local_ray_from_px", glm::mat3(inputs.view.local_ray_from_px()));
  slice_program_.set("view_px_per_px", glm::vec2(inputs.view.width, inputs.view.height) / glm::vec2(layout.picture_px));
  slice_program_.set("texels_from_local", glm::mat4(texels_from_local_));
  slice_program_.set("map_size", glm::vec2(casters.size_px()));
  layout.set(slice_program_);
  draw_into(to_slices_);
}

void SliceTrees::draw_leaves(const ShaftInputs& inputs, const CasterMap& casters) {
  leaves_program_.use();
  casters.bind(leaves_program_, inputs, kMapUnit);
  leaves_program_.set("eye_in_texels", glm::vec2(texels_from_local_[3]));
  leaves_program_.set("slices", 0);
  slices_.bind(0);
  draw_into(to_leaves_);
  CasterMap::unbind(kMapUnit);
}

void SliceTrees::draw_nodes() {
  blocks_program_.use();
  blocks_program_.set("leaves", 0);
  leaves_.bind(0);
  draw_into(to_blocks_);
  nodes_program_.use();
  nodes_program_.set("blocks", 0);
  nodes_program_.set("level_first", level_first_);
  blocks_.bind(0);
  draw_into(to_nodes_);
}

void SliceTrees::update(const ShaftInputs& inputs, const CasterMap& casters, const LineLayout& layout) {
  plain_state();
  make_storage(casters, layout.rows);
  // Inside a box the light's own way has kinks, which long nodes would straddle.
  top_level_ = inputs.scene.medium->extent ? 1 : 3;
  draw_slices(inputs, casters, layout);
  draw_leaves(inputs, casters);
  draw_nodes();
  glDisable(GL_SCISSOR_TEST);
}

void SliceTrees::bind(const gl::Program& program, int first_unit) const {
  program.set("slices", first_unit);
  program.set("leaves", first_unit + 1);
  program.set("nodes", first_unit + 2);
  slices_.bind(first_unit);
  leaves_.bind(first_unit + 1);
  nodes_.bind(first_unit + 2);
  program.set("level_first", level_first_);
  program.set("top_level", top_level_);
  program.set("texels_from_local", glm::mat4(texels_from_local_));
}

}  // namespace render
