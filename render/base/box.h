#pragma once

#include <glm/vec3.hpp>

namespace render {

// An axis-aligned box in the world, metres.
struct Box {
  glm::dvec3 min_in_world{0.0};
  glm::dvec3 max_in_world{0.0};
};

}  // namespace render
