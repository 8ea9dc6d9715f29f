#pragma once

#include <compare>
#include <vector>

#include "render/gl/shader_source.h"

namespace render {

// What of shaders/composite/layers.glsl a program is compiled for.
struct LayersVariant {
  enum class ShaftSize { Any, Half, Whole };  // exactly half the ideal picture's width and height, or as large

  bool objects = false;
  bool shafts = false;
  bool lens = false;  // all are looked up through the lens map
  ShaftSize shaft_size = ShaftSize::Any;

  auto operator<=>(const LayersVariant&) const = default;

  void add_defines(gl::Defines& defines) const;
};

// All that there are: a shaft picture's size counts only without a lens.
std::vector<LayersVariant> layers_variants();

}  // namespace render
