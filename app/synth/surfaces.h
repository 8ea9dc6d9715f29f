#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/synth/gaze.h"
#include "app/synth/spec.h"
#include "app/synth/texture.h"

namespace app::synth {

const std::vector<std::string>& ground_surfaces();
const std::vector<std::string>& box_surfaces();

// The ground near the scene in two parts, fine before the eye and coarser about it; the surface within the extent, the
// surrounding one beyond, with the border between stones and grass as it grows. The relief shades itself from the sun.
// What `gaze` never sees is left without detail.
struct GroundTextures {
  struct Part {
    Texture texture;
    glm::vec2 origin{0.0F};  // its south-west corner in the world
  };
  std::array<Part, 2> parts;  // finest first
  Texture around;             // repeats beyond
};
GroundTextures bake_ground(const GroundSpec& ground, const glm::vec2& eye, const glm::vec2& focus,
                           const glm::vec3& sun_direction, const Gaze& gaze, std::uint32_t seed);

// A wall's or block's surface, (u, v) in metres with v up.
Texture bake_box_surface(const std::string& surface, std::uint32_t seed);

}  // namespace app::synth
