#pragma once

#include "render/shafts/march/closed_form.h"
#include "render/shafts/march/march.h"
#include "render/shafts/medium_program.h"
#include "render/shafts/occluder_map.h"
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
        march_("shafts/low_res_visibility.frag", steps.defines(), steps.sun_disc),
        open_(1) {}

  const ShaftPicture& draw(const ShaftInputs& inputs) override;

 private:
  void draw_small(const ShaftInputs& inputs, const glm::ivec2& small_px);

  MarchSteps steps_;
  int divisor_;
  int radius_px_;
  OccluderMap occluders_{1};
  MediumProgram march_;
  MediumProgram upscale_{MediumProgram::SkyAtCorners{}, "shafts/bilateral.frag"};
  gl::Texture small_;
  gl::Framebuffer to_small_;
  gl::VertexArray no_vertices_;
  ShaftTarget target_;
  ClosedForm open_;
};

}  // namespace render
