#pragma once

#include "render/gl/texture.h"
#include "render/shafts/march/closed_form.h"
#include "render/shafts/reference/shaft_reference.h"

namespace render {

// The reference as a technique: surfaces as the GPU draws them end the rays, and the CPU's picture goes back to it, in
// 32-bit floats. Says on the log how far it is, every few seconds.
class ReferenceTechnique : public ShaftTechnique {
 public:
  explicit ReferenceTechnique(ReferenceSettings settings) : settings_(std::move(settings)) {}

  const ShaftPicture& draw(const ShaftInputs& inputs) override;
  std::optional<ShaftError> error() const override { return error_; }

 private:
  ReferenceSettings settings_;
  ClosedForm closed_form_{1};  // for its distances
  gl::Texture scattered_;
  ShaftPicture picture_;
  std::optional<ShaftError> error_;
};

// Makes `reference` known to shaft_techniques(). A program calls it once, before it reads its command line.
void add_shaft_reference();

}  // namespace render
