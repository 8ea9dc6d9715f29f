#include "render/shafts/medium_program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace render {
namespace {

// Of cells whose corners tell the sky's light: a tile of a software rasteriser. Smaller ones cost more than they save.
constexpr int kLargestCellPx = 64;

// A shader's variant.
enum : int {
  kBounded = 1,
  kFalloff = 2,
  kNoDepth = 4,
  kDivided = 8,
  kVirtualOccluders = 16,
  kRealOccluders = 32,
  kCorners = 64,
  kParted = 128
};

// Texture units of the shadow maps, compared and plain, and of their bounds.
constexpr std::array<std::pair<Occluders, int>, 2> kMapUnits{{{Occluders::Virtual, 2}, {Occluders::Real, 5}}};

int phase_kind(PhaseFunction function) {
  switch (function) {
    case PhaseFunction::HenyeyGreenstein:
      return 0;
    case PhaseFunction::CornetteShanks:
      return 1;
    case PhaseFunction::Rayleigh:
      break;
  }
  return 2;
}

// Sky radiance after one scattering: Funk-Hecke, each band times the phase function's moment.
std::array<glm::vec3, 9> sky_scatter_sh(const SceneState& scene) {
  const glm::dvec3 moments = phase_moments(scene.medium->phase_function, scene.medium->g);
  std::array<glm::vec3, 9> out{};
  for (std::size_t i = 0; i < 9; ++i) {
    const double moment = i == 0 ? moments[0] : i < 4 ? moments[1] : moments[2];
    out[i] = glm::vec3(scene.sky_light.radiance_sh[i] *
                       (moment * scene.medium->albedo * scene.medium->fog_gain * scene.exposure));
  }
  return out;
}

void set_light(const gl::Program& program, const SceneState& scene) {
  const Medium& medium = *scene.medium;
  program.set("sun_direction", glm::vec3(glm::normalize(sun_of(scene).direction_in_world)));
  program.set("sun_scattered",
              glm::vec3(sun_of(scene).illuminance_rgb * (medium.albedo * medium.shaft_gain * scene.exposure)));
  const std::array<glm::vec3, 9> sky = sky_scatter_sh(scene);
  program.set("sky_scatter_sh", sky.data(), 9);
  program.set("phase_kind", phase_kind(medium.phase_function));
  program.set("phase_g", static_cast<float>(medium.g));
}

void set_medium(const gl::Program& program, const ShaftInputs& inputs) {
  const View& view = inputs.view;
  const Medium& medium = *inputs.scene.medium;
  program.set("extinction", static_cast<float>(medium.extinction_per_m));
  program.set("sun_direction_in_local", glm::vec3(glm::normalize(sun_of(inputs.scene).direction_in_world)));
  if (medium.extent) {
    program.set("box_low_in_local", glm::vec3(medium.extent->min_in_world - view.eye_in_world));
    program.set("box_high_in_local", glm::vec3(medium.extent->max_in_world - view.eye_in_world));
  }
  if (medium.falloff) {
    // Kept as a logarithm: far above or below the base the extinction itself leaves single precision.
    const double log_extinction = std::log(std::max(medium.extinction_per_m, 1e-30)) -
                                  (view.eye_in_world.z - medium.falloff->base_m) / medium.falloff->scale_height_m;
    program.set("log_extinction", static_cast<float>(log_extinction));
    program.set("scale_height_m", static_cast<float>(medium.falloff->scale_height_m));
  }
}

void set_view(const gl::Program& program, const ShaftInputs& inputs, const glm::ivec2& size_px) {
  program.set("local_ray_from_px", glm::mat3(inputs.view.local_ray_from_px()));
  program.set("view_px_per_px", glm::vec2(inputs.view.width, inputs.view.height) / glm::vec2(size_px));
  program.set("near_m", static_cast<float>(View::kNearM));
  program.set("view_depth", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, inputs.depth);
}

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

int MediumProgram::variant_of(const ShaftInputs& inputs, const glm::ivec2& size_px, const AxisRange& range) const {
  const Medium& medium = *inputs.scene.medium;
  const auto cast = [&](Occluders kind) { return sun_disc_ && !inputs.occluders().map(kind).fit.empty; };
  const bool corners = sky_at_corners_ && cell_px(inputs.view, size_px) == kLargestCellPx;
  return (corners ? kCorners : 0) | (range.all() ? 0 : kParted) | (medium.extent ? kBounded : 0) |
         (medium.falloff ? kFalloff : 0) | (inputs.depth == 0 ? kNoDepth : 0) |
         (size_px.x < inputs.view.width ? kDivided : 0) | (cast(Occluders::Virtual) ? kVirtualOccluders : 0) |
         (cast(Occluders::Real) ? kRealOccluders : 0);
}

gl::Defines MediumProgram::defines_of(int variant) const {
  gl::Defines defines = defines_;
  if ((variant & kBounded) != 0) defines.push_back({"BOUNDED"});
  if ((variant & kFalloff) != 0) defines.push_back({"FALLOFF"});
  if ((variant & kNoDepth) != 0) defines.push_back({"NO_DEPTH"});
  if ((variant & kDivided) != 0) defines.push_back({"DIVIDED"});
  if ((variant & kCorners) != 0) defines.push_back({"SKY_AT_CORNERS"});
  if ((variant & kParted) != 0) defines.push_back({"CASCADE"});
  if (!sun_disc_) return defines;
  defines.insert(defines.end(), {{"SUN_DISC", ""}, {"BLOCKER_TAPS", "8"}, {"FILTER_TAPS", "16"}});
  if ((variant & kVirtualOccluders) != 0) defines.push_back({"VIRTUAL_OCCLUDERS"});
  if ((variant & kRealOccluders) != 0) defines.push_back({"REAL_OCCLUDERS"});
  return defines;
}

void MediumProgram::set_sun_disc(const gl::Program& program, const ShaftInputs& inputs) const {
  program.set("sun_disc_slope", static_cast<float>(std::tan(sun_of(inputs.scene).angular_radius_rad)));
  for (const auto& [kind, unit] : kMapUnits) {
    inputs.occluders().bind(kind, inputs.view, program, unit);
    inputs.occluders().bind_bounds(kind, program, unit + 2);
  }
}

const gl::Program& MediumProgram::use(const ShaftInputs& inputs, const glm::ivec2& size_px, const AxisRange& range) {
  const int variant = variant_of(inputs, size_px, range);
  auto found = variants_.find(variant);
  if (found == variants_.end()) {
    found = variants_
                .emplace(variant,
                         gl::Program((variant & kCorners) != 0 ? std::string_view("shafts/cells.vert") : vertex_path_,
                                     path_, defines_of(variant)))
                .first;
  }
  found->second.use();
  set_view(found->second, inputs, size_px);
  set_medium(found->second, inputs);
  set_light(found->second, inputs.scene);
  if (!range.all()) {
    // Beyond what any ray reaches: single precision has no endless ways to multiply with.
    found->second.set("cascade_m", glm::vec2(range.from_m, std::min(range.to_m, 1e30)));
  }
  if (sun_disc_) set_sun_disc(found->second, inputs);
  cells_ = glm::ivec2(0);
  if ((variant & kCorners) != 0) set_cells(found->second, inputs.view, size_px);
  return found->second;
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

void MediumProgram::release() const {
  if (!sun_disc_) return;
  for (const auto& [kind, unit] : kMapUnits) SunShadow::unbind(unit);
}

}  // namespace render
