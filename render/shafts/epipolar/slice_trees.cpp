#include "render/shafts/epipolar/slice_trees.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <vector>

#include "render/shafts/shaft_target.h"

namespace render {
namespace {

constexpr int kLargestNode = 1024;       // cells; the smallest has 16, each level four times as many as the one below
constexpr double kDepthSteps = 65534.0;  // minmax_leaves.frag keeps depth in 16 bits

// As lay_slices() says, for the line from `eye` along `across`, both in texels, over a map of that size.
glm::vec4 slice_across(const glm::dvec2& across, const glm::dvec2& eye, const glm::dvec2& size) {
  const double largest = std::max(std::abs(across.x), std::abs(across.y));
  const glm::dvec2 direction = largest > 1e-12 ? across / largest : glm::dvec2(1.0, 0.0);
  double enter = 0.0;
  double leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    if (std::abs(direction[axis]) < 1e-12) {
      if (eye[axis] < 0.0 || eye[axis] > size[axis]) leave = -1.0;
      continue;
    }
    const double a = -eye[axis] / direction[axis];
    const double b = (size[axis] - eye[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (leave <= enter) return {direction, 0.0, 0.0};
  // Cells begin where the line crosses from texel to texel along its axis.
  const int axis = std::abs(direction.x) >= std::abs(direction.y) ? 0 : 1;
  const double part = eye[axis] - std::floor(eye[axis]);
  const double before = direction[axis] > 0.0 ? part : 1.0 - part;
  const double first = std::floor(enter + before + 1e-6);
  return {direction, first - before, std::max(std::ceil(leave + before - 1e-6) - first, 0.0)};
}

}  // namespace

void SliceTrees::make_storage(const OccluderMap& occluders, int rows) {
  const glm::ivec2 size = occluders.size_px();
  const int cells = (std::max(size.x, size.y) + kLargestNode - 1) / kLargestNode * kLargestNode;
  rows_ = rows;
  if (cells == cells_ && slices_.height() >= rows) return;
  cells_ = cells;
  level_first_ = {0, cells / 16, cells / 16 + cells / 64, cells / 16 + cells / 64 + cells / 256};
  slices_ = gl::Texture(GL_RGBA32F, 1, rows, gl::Filter::Nearest, 1, "epipolar slices");
  leaves_ = gl::Texture(GL_RGBA32UI, cells / 4, rows, gl::Filter::Nearest, 1, "occluders of slices");
  blocks_ = gl::Texture(GL_RG16UI, cells / 16, rows, gl::Filter::Nearest, 1, "bounds of 16 cells");
  levels_ = gl::Texture(GL_RG16UI, level_first_.w + cells / 1024, rows, gl::Filter::Nearest, 1, "min-max trees");
  to_leaves_ = gl::Framebuffer({&leaves_}, nullptr, "occluders of slices");
  to_blocks_ = gl::Framebuffer({&blocks_, &levels_}, nullptr, "bounds of 16 cells");
  to_levels_ = gl::Framebuffer({&levels_}, nullptr, "min-max trees");
}

void SliceTrees::lay_slices(const ShaftInputs& inputs, const OccluderMap& occluders, const LineLayout& layout) {
  const glm::dvec3 steps(occluders.size_px(), kDepthSteps);
  texels_from_local_ =
      glm::scale(glm::dmat4(1.0), steps) * occluders.map_from_world() * glm::inverse(inputs.view.local_from_world());
  const glm::dvec2 scale = glm::dvec2(inputs.view.width, inputs.view.height) / glm::dvec2(layout.picture_px);
  const glm::dmat3 texels_from_px = glm::dmat3(texels_from_local_) * inputs.view.local_ray_from_px();
  std::vector<glm::vec4> slices;
  slices.reserve(static_cast<std::size_t>(rows_));
  for (int row = 0; row < rows_; ++row) {
    const glm::dvec2 across(texels_from_px * glm::dvec3(layout.end_px(row) * scale, 1.0));
    slices.push_back(slice_across(across, glm::dvec2(texels_from_local_[3]), glm::dvec2(occluders.size_px())));
  }
  slices_.upload(0, 0, 1, rows_, GL_RGBA, GL_FLOAT, slices.data());
}

// Of the slices' cells alone, 16 to a block.
void SliceTrees::draw_cells(const gl::Framebuffer& target, const gl::Program& program, int pixels_a_block) const {
  target.bind();
  program.bind("slices", slices_.handle());
  program.set("rows", rows_);
  program.set("pixels_a_block", static_cast<float>(pixels_a_block));
  program.set("half_size_px", 0.5F * glm::vec2(target.width(), target.height()));
  draw_row_groups(no_vertices_, rows_);
}

void SliceTrees::draw_leaves(const OccluderMap& occluders) {
  leaves_program_.use();
  occluders.bind_depth(leaves_program_);
  leaves_program_.set("occluder_texel", 1.0F / glm::vec2(occluders.size_px()));
  leaves_program_.set("eye_in_texels", glm::vec2(texels_from_local_[3]));
  leaves_program_.set("slices_texel", 1.0F / static_cast<float>(slices_.height()));
  draw_cells(to_leaves_, leaves_program_, 4);
}

void SliceTrees::draw_levels() {
  blocks_program_.use();
  blocks_program_.bind("leaves", leaves_.handle());
  blocks_program_.set("leaves_texel", 1.0F / glm::vec2(leaves_.width(), leaves_.height()));
  draw_cells(to_blocks_, blocks_program_, 1);
  levels_program_.use();
  levels_program_.bind("slices", slices_.handle());
  levels_program_.bind("blocks", blocks_.handle());
  levels_program_.set("level_first", level_first_);
  to_levels_.bind();
  confine_to({level_first_.y, 0, to_levels_.width() - level_first_.y, rows_});
  gl::draw_full_screen(no_vertices_);
}

void SliceTrees::update(const ShaftInputs& inputs, const OccluderMap& occluders, const LineLayout& layout) {
  plain_state();
  make_storage(occluders, layout.rows);
  // Inside a box the light's own way has kinks, which long levels would straddle.
  top_level_ = inputs.scene.medium->extent ? 1 : 3;
  lay_slices(inputs, occluders, layout);
  draw_leaves(occluders);
  draw_levels();
  glDisable(GL_SCISSOR_TEST);
}

void SliceTrees::bind(const gl::Program& program) const {
  program.bind("slices", slices_.handle());
  program.bind("leaves", leaves_.handle());
  program.bind("levels", levels_.handle());
  program.set("level_first", level_first_);
  program.set("top_level", top_level_);
  program.set("leaves_texel", 1.0F / glm::vec2(leaves_.width(), leaves_.height()));
  program.set("levels_texel", 1.0F / glm::vec2(levels_.width(), levels_.height()));
  program.set("texels_from_local", glm::mat4(texels_from_local_));
}

}  // namespace render
