#pragma once

#include <vector>

#include "data/generator/outline.h"
#include "data/generator/random.h"
#include "render/scene/model.h"

namespace generator {

// The wood texture (textures.h) is made of upright bands, each a plank's width of grain: seven tones of long grain and
// one of end grain. Every board takes its own piece of one band.
struct WoodSheet {
  static constexpr int kBands = 8;            // the last is end grain
  static constexpr float kBandWidth = 0.16F;  // metres across the grain
  static constexpr float kLength = 1.6F;      // metres along the grain, tileable
};

// Boards of one wooden thing, with the small irregularities of sawn timber.
class Timber {
 public:
  Timber(render::Mesh& mesh, std::uint32_t seed) : mesh_(mesh), random_(seed) {}

  // A bevelled beam from a to b, `size` across: size.x along `side` (made orthogonal to the beam), size.y along the
  // third direction.
  void beam(const glm::vec3& a, const glm::vec3& b, const glm::vec3& side, const glm::vec2& size, float bevel);

  // A beam whose side view has the given outline: x along `along` from the centre, y along `up`; `thickness` across.
  void shaped(const glm::vec3& centre, const glm::vec3& along, const glm::vec3& up,
              const std::vector<glm::vec2>& outline, float thickness, float bevel);

 private:
  float band_start();
  render::Mesh& mesh_;
  Random random_;
};

// Outline of a beam about its centre with both lower ends cut to an ogee, the joiner's classic for pergolas.
std::vector<glm::vec2> ogee_beam(float length, float height);

// The wood material and its three textures, appended to the model. Returns the material's index.
int add_wood(render::Model& model);

}  // namespace generator
