#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "app/synth/light.h"
#include "app/synth/spec.h"

namespace app::synth {

const std::vector<std::string>& plant_kinds();

// A plant painted leaf by leaf onto an upright card: radiance over its own transparency, row 0 at the top.
struct Painting {
  int width = 0;
  int height = 0;
  std::vector<glm::vec4> texels;  // premultiplied cd/m2, coverage

  // Mip-mapped look-up at (u, v) in [0, 1], footprint in texels of this level; outside: clear.
  glm::vec4 sample(glm::vec2 uv, float footprint_texels) const;
  void build_levels();

 private:
  std::vector<Painting> levels_;
  glm::vec4 bilinear(glm::vec2 uv) const;
};

// Paints the plant as seen along the horizontal direction `view` (from the eye to the plant), lit by `light`, with
// `texels_per_m`.
Painting paint_plant(const PlantSpec& plant, const glm::vec2& view, const Light& light, float texels_per_m,
                     std::uint32_t seed);

}  // namespace app::synth
