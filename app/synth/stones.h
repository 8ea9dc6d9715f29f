#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace app::synth {

// Nearest stone of an irregular pattern: jittered grid points (Worley 1996), distance to the border after Quilez.
struct Stone {
  glm::ivec2 cell{0};
  glm::vec2 centre{0.0F};
  float border = 0.0F;  // distance to the nearest edge, in cells
};

// The stone at a place, in cells.
Stone find_stone(glm::vec2 p, std::uint32_t seed);

// The colours of one quarry's limestone: buff, honey, grey, rose, each stone (`h`: its hash) with its own mix.
glm::vec3 stone_colour(std::uint32_t h);

}  // namespace app::synth
