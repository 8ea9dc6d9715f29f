#pragma once

#include "render/composite/ideal_view.h"
#include "render/composite/layers_variant.h"
#include "render/gl/program.h"
#include "render/shafts/shaft_technique.h"
#include "render/surface/objects_pass.h"

namespace render {

// What is laid over a picture: out = (picture * M + A) * T + L. All of it is borrowed for the call.
struct CompositeLayers {
  const ObjectsPicture* objects = nullptr;  // null: M = 1, A = 0
  const ShaftPicture* shafts = nullptr;     // null: T = 1, L = 0
  const LensLookup* lens = nullptr;         // null: the ideal picture is the real one, pixel by pixel
  const View* view = nullptr;               // the ideal picture; needed with shafts

  LayersVariant variant() const;
};

// Sets the samplers and uniforms of shaders/composite/layers.glsl.
void bind_layers(const CompositeLayers& layers, const gl::Program& program);

}  // namespace render
