#pragma once

#include "render/shafts/medium_program.h"
#include "render/shafts/shaft_target.h"

namespace render {

// Nothing between sun and medium: one closed form a pixel.
class ClosedForm : public ShaftTechnique {
 public:
  explicit ClosedForm(int divisor) : divisor_(divisor) {}

  const ShaftPicture& draw(const ShaftInputs& inputs) override {
    const glm::ivec2 size_px = shaft_size(inputs.view, divisor_);
    target_.begin(inputs, size_px);
    shading_.use(inputs, size_px);
    shading_.draw();
    glDisable(GL_SCISSOR_TEST);
    return target_.picture();
  }

 private:
  int divisor_;
  MediumProgram shading_{MediumProgram::SkyAtCorners{}, "shafts/shading.frag"};
  ShaftTarget target_;
};

}  // namespace render
