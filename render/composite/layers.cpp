#include "render/composite/layers.h"

namespace render {
namespace {

enum Feature : unsigned { kObjects = 1, kShafts = 2, kLens = 4, kShaftsHalf = 8, kShaftsWhole = 16 };

void bind(const gl::Program& program, const char* sampler, int unit, GLuint texture) {
  program.set(sampler, unit);
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D, texture);
}

}  // namespace

unsigned CompositeLayers::variant() const {
  const auto shafts_are_a = [&](int part) {
    return shafts != nullptr && lens == nullptr && part * shafts->width == view->width &&
           part * shafts->height == view->height;
  };
  return (objects != nullptr ? kObjects : 0U) | (shafts != nullptr ? kShafts : 0U) | (lens != nullptr ? kLens : 0U) |
         (shafts_are_a(2) ? kShaftsHalf : 0U) | (shafts_are_a(1) ? kShaftsWhole : 0U);
}

void add_layer_defines(unsigned variant, gl::Defines& defines) {
  if ((variant & kObjects) != 0) defines.push_back({"OBJECTS"});
  if ((variant & kShafts) != 0) defines.push_back({"SHAFTS"});
  if ((variant & kLens) != 0) defines.push_back({"LENS"});
  if ((variant & kShaftsHalf) != 0) defines.push_back({"SHAFTS_HALF"});
  if ((variant & kShaftsWhole) != 0) defines.push_back({"SHAFTS_WHOLE"});
}

void bind_layers(const CompositeLayers& layers, const gl::Program& program) {
  if (layers.objects != nullptr) {
    bind(program, "objects_added", kLayersUnit, layers.objects->added);
    bind(program, "objects_multiplier", kLayersUnit + 1, layers.objects->multiplier);
    bind(program, "ideal_depth", kLayersUnit + 2, layers.objects->depth);
  }
  if (layers.shafts != nullptr) {
    bind(program, "shafts", kLayersUnit + 3, layers.shafts->texture);
    bind(program, "shafts_distance", kLayersUnit + 4, layers.shafts->distance);
    program.set("shafts_size", glm::vec2(layers.shafts->width, layers.shafts->height));
    program.set("ideal_size", glm::vec2(layers.view->width, layers.view->height));
    program.set("near_m", static_cast<float>(View::kNearM));
  }
  if (layers.lens != nullptr) bind(program, "lens_map", kLayersUnit + 5, layers.lens->texture().id());
}

}  // namespace render
