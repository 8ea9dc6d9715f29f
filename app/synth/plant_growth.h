#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "app/synth/spec.h"

namespace app::synth {

// A leaf or a short piece of a twig, in the plant's frame: x east, y north, z up, origin at the foot.
struct Leaf {
  glm::vec3 place{0.0F};
  glm::vec3 along{0.0F, 0.0F, 1.0F};  // half its length
  float half_width_m = 0.01F;
  glm::vec3 normal{0.0F, 0.0F, 1.0F};
  glm::vec3 albedo{0.1F};
  glm::vec3 through{0.0F};  // transmittance
};

// All leaves and wood of a plant; `right`: unit vector across the view, along which a hedge runs. Throws
// std::invalid_argument for a kind that plant_kinds() does not list.
std::vector<Leaf> grow(const PlantSpec& plant, const glm::vec2& right, std::uint32_t seed);

}  // namespace app::synth
