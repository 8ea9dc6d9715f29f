#include "render/composite/layers.h"

namespace render {

LayersVariant CompositeLayers::variant() const {
  using Size = LayersVariant::ShaftSize;
  const auto shafts_are_a = [&](int part) {
    return shafts != nullptr && lens == nullptr && part * shafts->width == view->width &&
           part * shafts->height == view->height;
  };
  return {.objects = objects != nullptr,
          .shafts = shafts != nullptr,
          .lens = lens != nullptr,
          .shaft_size = shafts_are_a(1)   ? Size::Whole
                        : shafts_are_a(2) ? Size::Half
                                          : Size::Any};
}

void bind_layers(const CompositeLayers& layers, const gl::Program& program) {
  if (layers.objects != nullptr) {
    program.bind("objects_added", {GL_TEXTURE_2D, layers.objects->added});
    program.bind("objects_multiplier", {GL_TEXTURE_2D, layers.objects->multiplier});
  }
  if (layers.shafts != nullptr) {
    if (layers.objects != nullptr) program.bind("ideal_depth", {GL_TEXTURE_2D, layers.objects->depth});
    program.bind("shafts", {GL_TEXTURE_2D, layers.shafts->texture});
    program.bind("shafts_distance", {GL_TEXTURE_2D, layers.shafts->distance});
    program.set("shafts_size", glm::vec2(layers.shafts->width, layers.shafts->height));
    program.set("ideal_size", glm::vec2(layers.view->width, layers.view->height));
    program.set("near_m", static_cast<float>(View::kNearM));
  }
  if (layers.lens != nullptr) program.bind("lens_map", layers.lens->texture().handle());
}

}  // namespace render
