#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>

#include "app/synth/spec.h"

namespace app::synth {

// One place of a surface before its relief is turned into slopes and shade.
struct Relief {
  glm::vec3 albedo{0.5F};
  float height_m = 0.0F;
  float gloss = 0.0F;
};

inline Relief blend(const Relief& a, const Relief& b, float t) {
  return {glm::mix(a.albedo, b.albedo, t), glm::mix(a.height_m, b.height_m, t), glm::mix(a.gloss, b.gloss, t)};
}

// A named surface at a place in metres. The same seed gives the same surface. Both throw std::invalid_argument for a
// name that ground_surfaces() or box_surfaces() does not list.
Relief box_relief(const std::string& surface, glm::vec2 p, std::uint32_t seed);
Relief simple_ground(const std::string& surface, glm::vec2 p, std::uint32_t seed);
// The ground of a scene at a place in the world: its surface within the extent, the surrounding one beyond.
Relief ground_relief(const GroundSpec& ground, glm::vec2 p, std::uint32_t seed);

}  // namespace app::synth
