#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/synth/spec.h"
#include "app/synth/texture.h"

namespace app::synth {

const std::vector<std::string>& ground_surfaces();
const std::vector<std::string>& box_surfaces();

// The ground near the scene: its own surface within the extent, the surrounding one beyond, with their border between
// stones and grass as it grows. Covers `side_m` about `center`; the relief shades itself from `sun_direction`.
struct GroundTextures {
  Texture near;            // at world - origin
  glm::vec2 origin{0.0F};  // south-west corner of `near`
  Texture around;          // repeats beyond
};
GroundTextures bake_ground(const GroundSpec& ground, const glm::vec2& center, const glm::vec3& sun_direction,
                           std::uint32_t seed);

// A wall's or block's surface, (u, v) in metres with v up.
Texture bake_box_surface(const std::string& surface, std::uint32_t seed);

}  // namespace app::synth
