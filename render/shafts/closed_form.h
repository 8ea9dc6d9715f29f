#pragma once

#include "render/shafts/shade_pass.h"

namespace render {

// Nothing between sun and medium: one closed form a pixel.
class ClosedForm : public ShaftTechnique {
 public:
  explicit ClosedForm(int divisor) : divisor_(divisor) {}

  const ShaftPicture& draw(const ShaftInputs& inputs) override {
    return shade_.draw(inputs, shaft_size(inputs.view, divisor_), nullptr);
  }

 private:
  int divisor_;
  ShadePass shade_;
};

}  // namespace render
