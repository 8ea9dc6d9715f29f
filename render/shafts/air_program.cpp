#include "render/shafts/air_program.h"

#include <algorithm>
#include <array>
#include <cmath>

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
    out[i] = glm::vec3(scene.sky_light.radiance_sh[i] *
                       (moment * scene.medium->albedo * scene.medium->fog_gain * scene.exposure));
  }
  return out;
}

void set_light(const gl::Program& program, const SceneState& scene) {
  const Medium& medium = *scene.medium;
  program.set("sun_direction", glm::vec3(glm::normalize(scene.sun.direction_in_world)));
  program.set("sun_scattered",
              glm::vec3(scene.sun.illuminance_rgb * (medium.albedo * medium.shaft_gain * scene.exposure)));
  const std::array<glm::vec3, 9> sky = sky_scatter_sh(scene);
  program.set("sky_scatter_sh", sky.data(), 9);
  program.set("phase_kind", phase_kind(medium.phase_function));
  program.set("phase_g", static_cast<float>(medium.g));
}

void set_medium(const gl::Program& program, const ShaftInputs& inputs) {
  const View& view = inputs.view;
  const Medium& medium = *inputs.scene.medium;
  program.set("extinction", static_cast<float>(medium.extinction_per_m));
  program.set("sun_direction_in_local", glm::vec3(glm::normalize(inputs.scene.sun.direction_in_world)));
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

}  // namespace

const gl::Program& AirProgram::use(const ShaftInputs& inputs, const glm::ivec2& size_px) {
  const Medium& medium = *inputs.scene.medium;
  const int key = (medium.extent ? 1 : 0) + (medium.falloff ? 2 : 0) + (inputs.depth == 0 ? 4 : 0) +
                  (size_px.x < inputs.view.width ? 8 : 0);
  auto found = variants_.find(key);
  if (found == variants_.end()) {
    gl::Defines defines = defines_;
    if (medium.extent) defines.push_back({"BOUNDED"});
    if (medium.falloff) defines.push_back({"FALLOFF"});
    if (inputs.depth == 0) defines.push_back({"NO_DEPTH"});
    if (size_px.x < inputs.view.width) defines.push_back({"DIVIDED"});
    found = variants_.emplace(key, gl::Program("lib/full_screen.vert", path_, defines)).first;
  }
  found->second.use();
  set_view(found->second, inputs, size_px);
  set_medium(found->second, inputs);
  set_light(found->second, inputs.scene);
  return found->second;
}

}  // namespace render
