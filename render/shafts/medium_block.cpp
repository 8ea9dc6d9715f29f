#include "render/shafts/medium_block.h"

#include <algorithm>
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
std::array<glm::vec4, 9> sky_scatter_sh(const SceneState& scene) {
  const Medium& medium = *scene.medium;
  const glm::dvec3 moments = phase_moments(medium.phase_function, medium.g);
  std::array<glm::vec4, 9> out{};
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double moment = i == 0 ? moments[0] : i < 4 ? moments[1] : moments[2];
    out[i] = glm::vec4(
        glm::vec3(scene.sky_light.radiance_sh[i] * (moment * medium.albedo * medium.fog_gain * scene.exposure)), 0.0F);
  }
  return out;
}

}  // namespace

MediumBlock medium_block(const SceneState& scene, const View& view) {
  const Medium& medium = *scene.medium;
  MediumBlock block;
  const glm::mat3 rays(view.local_ray_from_px());
  for (int column = 0; column < 3; ++column) {
    block.local_ray_from_px[static_cast<std::size_t>(column)] = glm::vec4(rays[column], 0.0F);
  }
  block.near_m = static_cast<float>(View::kNearM);
  block.sun_direction = glm::vec3(glm::normalize(sun_of(scene).direction_in_world));
  block.sun_scattered = glm::vec3(sun_of(scene).illuminance_rgb * (medium.albedo * medium.shaft_gain * scene.exposure));
  block.extinction = static_cast<float>(medium.extinction_per_m);
  if (medium.extent) {
    block.box_low_in_local = glm::vec3(medium.extent->min_in_world - view.eye_in_world);
    block.box_high_in_local = glm::vec3(medium.extent->max_in_world - view.eye_in_world);
  }
  if (medium.falloff) {
    // Kept as a logarithm: far above or below the base the extinction itself leaves single precision.
    block.log_extinction =
        static_cast<float>(std::log(std::max(medium.extinction_per_m, 1e-30)) -
                           (view.eye_in_world.z - medium.falloff->base_m) / medium.falloff->scale_height_m);
    block.scale_height_m = static_cast<float>(medium.falloff->scale_height_m);
  }
  block.sky_scatter_sh = sky_scatter_sh(scene);
  block.phase_g = static_cast<float>(medium.g);
  block.phase_kind = phase_kind(medium.phase_function);
  return block;
}

const gl::Buffer& MediumBlockBuffer::update(const MediumBlock& block) {
  if (written_ == block) return buffer_;
  if (!buffer_) {
    buffer_ = gl::Buffer(sizeof block, &block, GL_DYNAMIC_DRAW);
  } else {
    buffer_.update(0, sizeof block, &block);
  }
  written_ = block;
  return buffer_;
}

}  // namespace render
