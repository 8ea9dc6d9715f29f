#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "render/scene/model.h"

namespace generator {

// Turns a profile of (radius, z), from bottom to top seen from outside, about the vertical axis through `centre`.
// Normals are smooth except where the profile turns by more than 35 degrees. Texture: `tile_m` metres a tile.
void lathe(render::Mesh& mesh, const glm::vec3& centre, const std::vector<glm::vec2>& profile, int sides, float tile_m);

// A tube along points with a radius each, round in `sides` steps, closed at its end by a point.
void tube(render::Mesh& mesh, const std::vector<glm::vec3>& points, const std::vector<float>& radii, int sides,
          float tile_m);

// A slightly folded leaf card: its foot, the direction it grows in, its face's direction, its size, and its piece of
// the texture from (u0, v0) of size `uv_size`. Shading normals lean towards `outward`, as foliage scatters.
struct Card {
  glm::vec3 foot;
  glm::vec3 along;
  glm::vec3 facing;
  glm::vec3 outward;
  float size;
  glm::vec2 uv;
  float uv_size;
};
void leaf_card(render::Mesh& mesh, const Card& card);

// A sphere of `rings` by `sides`, drawn out along `axis` by `stretch` with a small nipple at that end: a lemon.
void lemon(render::Mesh& mesh, const glm::vec3& centre, const glm::vec3& axis, float radius, int rings, int sides);

}  // namespace generator
