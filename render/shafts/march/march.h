#pragma once

#include <deque>

#include "render/shafts/march/closed_form.h"
#include "render/shafts/medium_program.h"
#include "render/shafts/occluder_map.h"
#include "render/shafts/shaft_target.h"

namespace render {

// How a march's steps lie along a ray.
struct MarchSteps {
  int count = 256;
  int spacing = 0;          // equal lengths, equal optical depths, or growing (Tan 2020, algorithm 1)
  double near_share = 0.5;  // growing: this share of the steps has equal lengths
  double near_m = 2.0;      // up to this far into the medium
  bool sun_disc = false;    // each sees the sun as a disc; else as a point

  gl::Defines defines() const;                 // what shaders/shafts/steps.glsl is compiled with
  void set(const gl::Program& program) const;  // and what it needs
};

// Brute force: every pixel marches its own ray against a map of the occluders, and stops where nothing more is seen.
class March : public ShaftTechnique {
 public:
  March(const MarchSteps& steps, int divisor)
      : steps_(steps),
        divisor_(divisor),
        march_("shafts/march.frag", steps.defines(), steps.sun_disc),
        open_(divisor) {}

  const ShaftPicture& draw(const ShaftInputs& inputs) override;

 private:
  MarchSteps steps_;
  int divisor_;
  std::deque<OccluderMap> occluders_;  // of each part of the medium
  MediumProgram march_;
  ShaftTarget target_;
  ClosedForm open_;
};

}  // namespace render
