#include <cmath>

#include "data/generator/models.h"
#include "data/generator/timber.h"

namespace generator {
namespace {

const glm::vec3 kEast(1, 0, 0);
const glm::vec3 kNorth(0, 1, 0);
const glm::vec3 kUp(0, 0, 1);

// Outline of an upright lath with a round head, x along its height.
std::vector<glm::vec2> round_headed(float length, float width) {
  const float half = 0.5F * length;
  const float r = 0.5F * width;
  std::vector<glm::vec2> outline{{-half, r}, {-half, -r}};
  constexpr int kSteps = 8;
  for (int i = 0; i <= kSteps; ++i) {
    const float a = 3.14159265F * (static_cast<float>(i) / kSteps - 0.5F);
    outline.emplace_back(half - r + r * std::cos(a), r * std::sin(a));
  }
  return outline;
}

}  // namespace

render::Model make_gate() {
  render::Model model;
  model.name = "gate";
  model.meshes.resize(1);
  Timber timber(model.meshes[0], 31);
  for (const float x : {-0.745F, 0.745F}) {
    timber.beam({x, 0, 0}, {x, 0, 1.62F}, kEast, {0.11F, 0.11F}, 0.012F);
    timber.beam({x, 0, 1.615F}, {x, 0, 1.655F}, kEast, {0.15F, 0.15F}, 0.012F);
    timber.beam({x, 0, 1.65F}, {x, 0, 1.70F}, kEast, {0.085F, 0.085F}, 0.02F);
  }
  // Frame behind the laths: two rails and a brace that runs up from the hinge side.
  for (const float z : {0.30F, 1.16F})
    timber.beam({-0.67F, 0.022F, z}, {0.67F, 0.022F, z}, kUp, {0.085F, 0.034F}, 0.004F);
  timber.beam({-0.64F, 0.0225F, 0.345F}, {0.64F, 0.0225F, 1.115F}, kNorth, {0.030F, 0.07F}, 0.004F);
  constexpr int kLaths = 11;
  for (int i = 0; i < kLaths; ++i) {
    const float t = 2.0F * static_cast<float>(i) / (kLaths - 1) - 1.0F;
    const float top = 1.30F + 0.22F * (1.0F - t * t);  // the heads follow an arch
    const float bottom = 0.08F;
    timber.shaped({t * 0.61F, -0.0065F, 0.5F * (top + bottom)}, kUp, -kEast, round_headed(top - bottom, 0.07F), 0.022F,
                  0.003F);
  }
  model.meshes[0].material = add_wood(model);
  return model;
}

render::Model make_post() {
  render::Model model = render::make_box({0.1F, 0.1F, 2.0F});
  model.name = "post";
  model.materials[0].name = "post";
  model.materials[0].base_color = glm::vec4(0.62F, 0.60F, 0.56F, 1.0F);
  model.materials[0].roughness = 0.7F;
  for (render::Vertex& vertex : model.meshes[0].vertices) vertex.position.z += 1.0F;
  return model;
}

}  // namespace generator
