#pragma once

#include <memory>
#include <string>

#include "render/shafts/medium_program.h"
#include "render/shafts/occluder_map.h"
#include "render/shafts/shaft_target.h"

namespace render {

// Another technique's picture, tinted where the sun's light comes through glass. Techniques know of the occluders that
// hold up light altogether; all share this one pass for those that colour it, and it runs only where a scene has them.
class TranslucentTint : public ShaftTechnique {
 public:
  explicit TranslucentTint(std::unique_ptr<ShaftTechnique> untinted) : untinted_(std::move(untinted)) {}

  const ShaftPicture& draw(const ShaftInputs& inputs) override;
  std::optional<ShaftError> error() const override { return untinted_->error(); }

 private:
  void make_storage(const ShaftPicture& size);

  std::unique_ptr<ShaftTechnique> untinted_;
  OccluderMap occluders_{1};
  MediumProgram alone_{"shafts/translucent_tint.frag"};
  MediumProgram among_occluders_{"shafts/translucent_tint.frag", {{"OCCLUDERS"}}};
  gl::Texture tinted_;
  gl::Framebuffer framebuffer_;
  ShaftPicture picture_;
};

}  // namespace render
