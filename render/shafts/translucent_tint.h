#pragma once

#include "render/shafts/medium_program.h"
#include "render/shafts/occluder_map.h"
#include "render/shafts/shaft_target.h"

namespace render {

// A technique's picture, tinted where the sun's light comes through translucent occluders. Techniques know of the
// occluders that hold up light altogether; all that do not say otherwise (ShaftTechniqueInfo) share this for those that
// colour it.
class TranslucentTint {
 public:
  // Through the light behind the panes alone, which is seldom many metres: its edges are as sharp as a march of many
  // times as many steps along whole rays makes them.
  static constexpr int kSteps = 128;

  // `untinted` was drawn from the same inputs, whose shadow has translucent occluders. Valid until the next draw.
  const ShaftPicture& draw(const ShaftInputs& inputs, const ShaftPicture& untinted);

 private:
  void make_storage(const ShaftPicture& size);

  OccluderMap occluders_{1};
  MediumProgram alone_{"shafts/translucent_tint.frag"};
  MediumProgram among_occluders_{"shafts/translucent_tint.frag", {{"OCCLUDERS"}}};
  gl::Texture tinted_;
  gl::Framebuffer framebuffer_;
  ShaftPicture picture_;
};

}  // namespace render
