#include <fmt/format.h>

#include "render/plan/features/features.h"
#include "render/plan/frame.h"
#include "render/shafts/translucent_tint.h"

namespace render::feature {
namespace {

// Shaft techniques know of the occluders that hold up light altogether; all share this pass for those that colour it.
class Translucency final : public FeaturePass {
 public:
  static Decision needed(const PlanRequest& request) {
    const SceneNeeds& needs = request.needs;
    if (!needs.nothing_drawn.empty()) return nothing_drawn(request);
    if (!needs.shafts) return NotNeeded{needs.no_shafts};
    if (!needs.translucent) return NotNeeded{"no occluder lets coloured light through"};
    const std::string& technique = request.quality.shafts.technique;
    const ShaftTechniqueInfo* info = find_shaft_technique(technique);
    if (info != nullptr && info->handles_translucency) {
      return NotNeeded{fmt::format("{}'s picture needs no tint", technique)};
    }
    return Needed{fmt::format("a march of {} steps behind the panes", TranslucentTint::kSteps),
                  "translucent occluders colour the sunlight in the medium"};
  }

  void draw(Frame& frame) override {
    // Large panes are cut to what can be seen: nothing may be left of them.
    if (frame.shadow->translucent().fit.empty) return;
    frame.shafts = &tint_.draw(frame.shaft_inputs(), *frame.shafts);
  }

 private:
  TranslucentTint tint_;
};

}  // namespace

constinit const Feature kTranslucency = feature_of<Translucency>("translucency");

}  // namespace render::feature
