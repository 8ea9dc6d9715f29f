#pragma once

#include <memory>
#include <string>

#include "render/shafts/air_program.h"
#include "render/shafts/caster_map.h"
#include "render/shafts/shaft_target.h"

namespace render {

// Another technique's picture, tinted where the sun's light comes through glass. Techniques know of the casters that
// hold up light altogether; all share this one pass for those that colour it, and it runs only where a scene has them.
class GlassTint : public ShaftTechnique {
 public:
  explicit GlassTint(std::unique_ptr<ShaftTechnique> untinted) : untinted_(std::move(untinted)) {}

  const ShaftPicture& draw(const ShaftInputs& inputs) override;
  std::optional<ShaftError> error() const override { return untinted_->error(); }

 private:
  void make_storage(const ShaftPicture& size);

  std::unique_ptr<ShaftTechnique> untinted_;
  CasterMap casters_{1};
  AirProgram alone_{"shafts/glass.frag"};
  AirProgram among_casters_{"shafts/glass.frag", {{"CASTERS"}}};
  gl::Texture tinted_;
  gl::Framebuffer framebuffer_;
  ShaftPicture picture_;
};

}  // namespace render
