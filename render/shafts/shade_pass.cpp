#include "render/shafts/shade_pass.h"

#include <array>

namespace render {
namespace {

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
    out[i] = glm::vec3(scene.sky_light.radiance_sh[i] * (moment * scene.medium->albedo * scene.exposure));
  }
  return out;
}

void set_light(const gl::Program& program, const SceneState& scene) {
  const Medium& medium = *scene.medium;
  program.set("sun_direction", glm::vec3(glm::normalize(scene.sun.direction_in_world)));
  program.set("sun_scattered", glm::vec3(scene.sun.illuminance_rgb * (medium.albedo * scene.exposure)));
  const std::array<glm::vec3, 9> sky = sky_scatter_sh(scene);
  program.set("sky_scatter_sh", sky.data(), 9);
  program.set("phase_kind", phase_kind(medium.phase_function));
  program.set("phase_g", static_cast<float>(medium.g));
}

}  // namespace

glm::ivec2 shaft_size(const View& view, int divisor) {
  return {(view.width + divisor - 1) / divisor, (view.height + divisor - 1) / divisor};
}

glm::ivec4 shaft_region(const ShaftInputs& inputs, const glm::ivec2& size_px, int margin_px) {
  const glm::ivec4 region = inputs.region_px;
  if (region.z <= 0 || region.w <= 0) return {0, 0, size_px.x, size_px.y};
  const glm::dvec2 ratio = glm::dvec2(size_px) / glm::dvec2(inputs.view.width, inputs.view.height);
  const glm::ivec2 margin(margin_px + 1);
  const glm::ivec2 low = glm::ivec2(glm::floor(ratio * glm::dvec2(region.x, region.y))) - margin;
  const glm::ivec2 high = glm::ivec2(glm::ceil(ratio * glm::dvec2(region.x + region.z, region.y + region.w))) + margin;
  const glm::ivec2 from = glm::clamp(low, glm::ivec2(0), size_px);
  const glm::ivec2 to = glm::clamp(high, glm::ivec2(0), size_px);
  return {from, to - from};
}

void confine_to(const glm::ivec4& region_px) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(region_px.x, region_px.y, region_px.z, region_px.w);
}

void set_ray(const gl::Program& program, const ShaftInputs& inputs, const glm::ivec2& size_px) {
  const View& view = inputs.view;
  const Medium& medium = *inputs.scene.medium;
  program.set("local_ray_from_px", glm::mat3(view.local_ray_from_px()));
  program.set("view_px_per_px", glm::vec2(view.width, view.height) / glm::vec2(size_px));
  program.set("near_m", static_cast<float>(View::kNearM));
  program.set("extinction", static_cast<float>(medium.extinction_per_m));
  program.set("sun_direction_in_local", glm::vec3(glm::normalize(inputs.scene.sun.direction_in_world)));
  if (medium.extent) {
    program.set("box_low_in_local", glm::vec3(medium.extent->min_in_world - view.eye_in_world));
    program.set("box_high_in_local", glm::vec3(medium.extent->max_in_world - view.eye_in_world));
  }
  program.set("view_depth", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, inputs.depth);
}

const gl::Program& ShadePass::program(bool bounded, bool marched, bool has_depth) {
  const int key = (bounded ? 1 : 0) + (marched ? 2 : 0) + (has_depth ? 4 : 0);
  auto found = programs_.find(key);
  if (found == programs_.end()) {
    gl::Defines defines;
    if (bounded) defines.push_back({"BOUNDED"});
    if (marched) defines.push_back({"MARCHED"});
    if (!has_depth) defines.push_back({"NO_DEPTH"});
    found = programs_.emplace(key, gl::Program("lib/full_screen.vert", "shafts/shade.frag", defines)).first;
  }
  return found->second;
}

void ShadePass::make_targets(const glm::ivec2& size_px) {
  if (picture_.width == size_px.x && picture_.height == size_px.y) return;
  scattered_ = gl::Texture(GL_RGBA16F, size_px.x, size_px.y, gl::Filter::Linear, 1, "shafts");
  distance_ = gl::Texture(GL_R32F, size_px.x, size_px.y, gl::Filter::Nearest, 1, "shaft distance");
  framebuffer_ = gl::Framebuffer({&scattered_, &distance_}, nullptr, "shafts");
  picture_ = {.texture = scattered_.id(), .distance = distance_.id(), .width = size_px.x, .height = size_px.y};
}

const ShaftPicture& ShadePass::draw(const ShaftInputs& inputs, const glm::ivec2& size_px,
                                    const gl::Texture* lit_and_distance) {
  make_targets(size_px);
  framebuffer_.bind();
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  const glm::ivec4 region = shaft_region(inputs, size_px, 0);
  if (region != glm::ivec4(0, 0, size_px.x, size_px.y)) {
    const std::array<float, 4> nothing{0.0F, 0.0F, 0.0F, 1.0F};
    const std::array<float, 4> far_away{1e9F, 0.0F, 0.0F, 0.0F};
    glClearBufferfv(GL_COLOR, 0, nothing.data());
    glClearBufferfv(GL_COLOR, 1, far_away.data());
    confine_to(region);
  }
  const gl::Program& shade =
      program(inputs.scene.medium->extent.has_value(), lit_and_distance != nullptr, inputs.depth != 0);
  shade.use();
  set_ray(shade, inputs, size_px);
  set_light(shade, inputs.scene);
  if (lit_and_distance != nullptr) {
    lit_and_distance->bind(1);
    shade.set("lit_and_distance", 1);
  }
  gl::draw_full_screen(no_vertices_);
  glDisable(GL_SCISSOR_TEST);
  return picture_;
}

}  // namespace render
