#pragma once

#include <glm/glm.hpp>
#include <variant>

namespace render {

// The sun as light: parallel, or a disc of that angular radius. By night the moon takes its place.
struct Sun {
  glm::dvec3 direction_in_world{0.0, 0.0, 1.0};  // unit, towards the sun
  glm::dvec3 illuminance_rgb{0.0};               // lux on a plane facing it; zero: no sun
  double angular_radius_rad = 0.0;               // 0: sharp shadows
  bool is_moon = false;                          // for what people are told
};

// Anything that a scene is lit by, besides its sky.
using Light = std::variant<Sun>;

}  // namespace render
