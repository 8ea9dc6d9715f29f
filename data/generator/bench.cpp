#include "data/generator/models.h"
#include "data/generator/timber.h"

namespace generator {

render::Model make_bench() {
  const glm::vec3 east(1, 0, 0);
  const glm::vec3 north(0, 1, 0);
  render::Model model;
  model.name = "bench";
  model.meshes.resize(1);
  Timber timber(model.meshes[0], 47);
  for (const float x : {-0.66F, 0.66F}) {
    timber.beam({x, -0.24F, 0.0F}, {x, -0.24F, 0.63F}, east, {0.06F, 0.06F}, 0.006F);
    timber.beam({x, 0.20F, 0.0F}, {x, 0.20F, 0.43F}, east, {0.06F, 0.06F}, 0.006F);
    timber.beam({x, 0.205F, 0.40F}, {x, 0.335F, 0.86F}, east, {0.058F, 0.058F}, 0.006F);  // the back leans
    timber.beam({x, -0.25F, 0.37F}, {x, 0.22F, 0.36F}, east, {0.045F, 0.07F}, 0.005F);
    timber.beam({x, -0.31F, 0.645F}, {x, 0.265F, 0.635F}, east, {0.075F, 0.032F}, 0.008F);  // arm rest
  }
  for (const float y : {-0.245F, 0.195F})
    timber.beam({-0.65F, y, 0.375F}, {0.65F, y, 0.375F}, north, {0.034F, 0.06F}, 0.005F);
  for (int i = 0; i < 6; ++i) {
    const float y = -0.265F + 0.088F * static_cast<float>(i);
    const float sag = 0.008F * (i > 0 && i < 5 ? 1.0F : 0.0F);
    timber.beam({-0.75F, y, 0.425F - sag}, {0.75F, y, 0.425F - sag}, north, {0.074F, 0.026F}, 0.006F);
  }
  for (int i = 0; i < 4; ++i) {
    const float t = static_cast<float>(i) / 3.0F;
    const float z = 0.53F + 0.29F * t;
    const float y = 0.205F + (z - 0.40F) * (0.13F / 0.46F) - 0.040F;
    timber.beam({-0.72F, y, z}, {0.72F, y, z}, {0.0F, -0.28F, -0.96F}, {0.07F, 0.022F}, 0.005F);
  }
  model.meshes[0].material = add_wood(model);
  return model;
}

}  // namespace generator
