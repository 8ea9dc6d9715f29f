#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "render/gl/buffer.h"
#include "render/scene/scene_state.h"
#include "render/scene/view.h"

namespace render {

// Medium, sun and view as shaders/shafts/medium_block.glsl has them: std140, columns and vectors of three in sixteen
// bytes.
struct MediumBlock {
  std::array<glm::vec4, 3> local_ray_from_px{};
  glm::vec3 sun_direction{0.0F};
  float near_m = 0.0F;
  glm::vec3 sun_scattered{0.0F};
  float extinction = 0.0F;
  glm::vec3 box_low_in_local{0.0F};
  float log_extinction = 0.0F;
  glm::vec3 box_high_in_local{0.0F};
  float scale_height_m = 0.0F;
  std::array<glm::vec4, 9> sky_scatter_sh{};
  float phase_g = 0.0F;
  int phase_kind = 0;
  glm::vec2 padding{0.0F};

  bool operator==(const MediumBlock&) const = default;
};
static_assert(sizeof(MediumBlock) == 272);

// `scene.medium` is present. Lights are pre-exposed.
MediumBlock medium_block(const SceneState& scene, const View& view);

// The block in memory of the GL, written again where it has changed.
class MediumBlockBuffer {
 public:
  const gl::Buffer& update(const MediumBlock& block);

 private:
  std::optional<MediumBlock> written_;
  gl::Buffer buffer_;
};

}  // namespace render
