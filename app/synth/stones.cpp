#include "app/synth/stones.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/synth/noise.h"

namespace app::synth {
namespace {

glm::vec2 stone_point(glm::ivec2 cell, std::uint32_t seed) {
  const std::uint32_t h = hash_cell(cell.x, cell.y, seed);
  return glm::vec2(cell) + 0.5F + 0.86F * (glm::vec2(unit_float(h), unit_float(mix_bits(h))) - 0.5F);
}

// The points of the cells about one cell. Neighbouring texels mostly ask for the same ones.
struct StonePoints {
  glm::ivec2 home{0};
  std::uint32_t seed = 0;
  bool known = false;
  std::array<glm::vec2, 25> points;

  void look_up(glm::ivec2 cell, std::uint32_t cell_seed) {
    if (known && home == cell && seed == cell_seed) return;
    home = cell;
    seed = cell_seed;
    known = true;
    for (int i = 0; i < 25; ++i)
      points[static_cast<std::size_t>(i)] = stone_point(cell + glm::ivec2(i % 5 - 2, i / 5 - 2), cell_seed);
  }
};

}  // namespace

Stone find_stone(glm::vec2 p, std::uint32_t seed) {
  thread_local StonePoints about;
  const glm::ivec2 home(floor_of(p.x), floor_of(p.y));
  about.look_up(home, seed);
  int nearest = 0;
  float nearest2 = 1e9F;
  for (int i = 0; i < 25; ++i) {
    const glm::vec2 to = about.points[static_cast<std::size_t>(i)] - p;
    const float d2 = glm::dot(to, to);
    if (d2 < nearest2) {
      nearest2 = d2;
      nearest = i;
    }
  }
  Stone stone;
  stone.cell = home + glm::ivec2(nearest % 5 - 2, nearest / 5 - 2);
  stone.centre = about.points[static_cast<std::size_t>(nearest)];
  stone.border = 1e9F;
  for (int i = 0; i < 25; ++i) {
    if (i == nearest) continue;
    const glm::vec2 q = about.points[static_cast<std::size_t>(i)];
    const glm::vec2 across = q - stone.centre;
    const float to_middle = glm::dot(0.5F * (q + stone.centre) - p, across);  // times the length of `across`
    const float length2 = glm::dot(across, across);
    if (to_middle * to_middle < stone.border * stone.border * length2)
      stone.border = std::max(to_middle, 0.0F) / std::sqrt(length2);
  }
  return stone;
}

glm::vec3 stone_colour(std::uint32_t h) {
  static const std::array<glm::vec3, 6> kPalette{glm::vec3(0.43F, 0.37F, 0.29F),   glm::vec3(0.39F, 0.32F, 0.235F),
                                                 glm::vec3(0.35F, 0.325F, 0.285F), glm::vec3(0.44F, 0.395F, 0.33F),
                                                 glm::vec3(0.38F, 0.30F, 0.24F),   glm::vec3(0.31F, 0.285F, 0.25F)};
  const auto first = static_cast<std::size_t>(unit_float(h) * 5.999F);
  const auto second = static_cast<std::size_t>(unit_float(mix_bits(h + 1U)) * 5.999F);
  return glm::mix(kPalette[first], kPalette[second], 0.5F * unit_float(mix_bits(h + 2U)));
}

}  // namespace app::synth
