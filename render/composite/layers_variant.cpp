#include "render/composite/layers_variant.h"

namespace render {

void LayersVariant::add_defines(gl::Defines& defines) const {
  if (objects) defines.push_back({"OBJECTS"});
  if (shafts) defines.push_back({"SHAFTS"});
  if (lens) defines.push_back({"LENS"});
  if (shaft_size == ShaftSize::Half) defines.push_back({"SHAFTS_HALF"});
  if (shaft_size == ShaftSize::Whole) defines.push_back({"SHAFTS_WHOLE"});
}

std::vector<LayersVariant> layers_variants() {
  using Size = LayersVariant::ShaftSize;
  std::vector<LayersVariant> all;
  for (const bool objects : {false, true}) {
    for (const bool lens : {false, true}) {
      all.push_back({.objects = objects, .lens = lens});
      all.push_back({.objects = objects, .shafts = true, .lens = lens});
    }
    for (const Size size : {Size::Half, Size::Whole}) {
      all.push_back({.objects = objects, .shafts = true, .shaft_size = size});
    }
  }
  return all;
}

}  // namespace render
