#pragma once

#include "render/shafts/air_program.h"
#include "render/shafts/caster_map.h"
#include "render/shafts/closed_form.h"
#include "render/shafts/march.h"
#include "render/shafts/shaft_target.h"

namespace render {

// Marches a small picture and scales it up to full size with a bilateral filter that keeps depth edges (Ali et al.
// 2017, realTiSoftLS). What is filtered is the lit part of the sunlight; the rest is computed for each pixel.
class Bilateral : public ShaftTechnique {
 public:
  // `radius_px`: how far the filter reaches, in pixels of the small picture.
  Bilateral(const MarchSteps& steps, int divisor, int radius_px)
      : steps_(steps),
        divisor_(divisor),
        radius_px_(radius_px),
        march_("shafts/small_lit.frag", steps.defines(), steps.sun_disc),
        open_(1) {}

  const ShaftPicture& draw(const ShaftInputs& inputs) override;

 private:
  void draw_small(const ShaftInputs& inputs, const glm::ivec2& small_px);

  MarchSteps steps_;
  int divisor_;
  int radius_px_;
  CasterMap casters_{1};
  AirProgram march_;
  AirProgram upscale_{AirProgram::SkyAtCorners{}, "shafts/bilateral.frag"};
  gl::Texture small_;
  gl::Framebuffer to_small_;
  gl::VertexArray no_vertices_;
  ShaftTarget target_;
  ClosedForm open_;
};

}  // namespace render
