#include "render/shafts/medium_program.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace render {
namespace {

// Of cells whose corners tell the sky's light: a tile of a software rasteriser. Smaller ones cost more than they save.
constexpr int kLargestCellPx = 64;

// Of the cells whose corners alone know the sky's light: the largest power of two, for a software rasteriser's tiles,
// at which interpolation is off by a thousandth of the harmonics' second band, and at most that of such a tile.
int cell_px(const View& view, const glm::ivec2& size_px) {
  constexpr double kCellRad = 0.055;
  const double focal_px = std::min(view.focal_px.x * size_px.x / view.width, view.focal_px.y * size_px.y / view.height);
  int size = 1;
  while (size < kLargestCellPx && 2.0 * size <= kCellRad * focal_px) size *= 2;
  return size;
}

}  // namespace

MediumVariant MediumProgram::variant_of(const ShaftInputs& inputs, const glm::ivec2& size_px,
                                        const AxisRange& range) const {
  using Depth = MediumVariant::Depth;
  const Medium& medium = *inputs.scene.medium;
  const auto cast = [&](Occluders kind) { return sun_disc_ && !inputs.occluders().map(kind).fit.empty; };
  return {.bounded = medium.extent.has_value(),
          .falloff = medium.falloff.has_value(),
          .depth = inputs.depth == 0               ? Depth::None
                   : size_px.x < inputs.view.width ? Depth::OfSeveral
                                                   : Depth::OfPixel,
          .cascade = !range.all(),
          .sky_at_corners = sky_at_corners_ && cell_px(inputs.view, size_px) == kLargestCellPx,
          .sun_disc = sun_disc_,
          .virtual_occluders = cast(Occluders::Virtual),
          .real_occluders = cast(Occluders::Real)};
}

const gl::Program& MediumProgram::program_for(const MediumVariant& variant) {
  const auto found = programs_.find(variant);
  if (found != programs_.end()) return found->second;
  gl::Defines defines = defines_;
  for (gl::Define& define : variant.defines()) defines.push_back(std::move(define));
  const std::string& vertex_path = variant.sky_at_corners ? "shafts/cells.vert" : vertex_path_;
  return programs_.emplace(variant, gl::Program(vertex_path, path_, defines)).first->second;
}

const gl::Program& MediumProgram::use(const ShaftInputs& inputs, const glm::ivec2& size_px, const AxisRange& range) {
  const MediumVariant variant = variant_of(inputs, size_px, range);
  const gl::Program& program = program_for(variant);
  program.use();
  program.bind_block("MediumBlock", block_.update(medium_block(inputs.scene, inputs.view)));
  program.set("view_px_per_px", glm::vec2(inputs.view.width, inputs.view.height) / glm::vec2(size_px));
  if (program.has("view_depth")) program.bind("view_depth", {GL_TEXTURE_2D, inputs.depth});
  if (variant.cascade) {
    // Beyond what any ray reaches: single precision has no endless ways to multiply with.
    program.set("cascade_m", glm::vec2(range.from_m, std::min(range.to_m, 1e30)));
  }
  if (variant.sun_disc) {
    program.set("sun_disc_slope", static_cast<float>(std::tan(sun_of(inputs.scene).angular_radius_rad)));
    inputs.occluders().bind(inputs.view, program);
  }
  cells_ = glm::ivec2(0);
  if (variant.sky_at_corners) set_cells(program, inputs.view, size_px);
  return program;
}

void MediumProgram::set_cells(const gl::Program& program, const View& view, const glm::ivec2& size_px) {
  const int size = cell_px(view, size_px);
  cells_ = (size_px + size - 1) / size;
  program.set("columns", cells_.x);
  program.set("cell_px", static_cast<float>(size));
  program.set("half_size_px", 0.5F * glm::vec2(size_px));
}

void MediumProgram::draw() const {
  if (cells_.x == 0) return gl::draw_full_screen(no_vertices_);
  no_vertices_.bind();
  glDrawArrays(GL_TRIANGLES, 0, 6 * cells_.x * cells_.y);
}

}  // namespace render
