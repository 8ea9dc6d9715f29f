#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "render/scene/model.h"

namespace bench_scenes {

// A hewn stone: a box of `size` about `centre` along the columns of `axes`, its edges rounded by `round` metres and its
// faces bulging by noise, each of them `cells` x `cells` quads: 12 cells^2 triangles. Texture: 0.4 m a tile, from a
// place of the stone's own.
struct RoughBlock {
  glm::vec3 centre;
  glm::mat3 axes{1.0F};
  glm::vec3 size;
  float round = 0.02F;
  float bulge = 0.01F;
  int cells = 3;
  std::uint32_t seed = 1;
};
void add_block(render::Mesh& mesh, const RoughBlock& block);

// A plain box, 12 triangles with flat faces, from corner to corner along the world's axes.
void add_box(render::Mesh& mesh, const glm::vec3& low, const glm::vec3& high, float tile_m);

}  // namespace bench_scenes
