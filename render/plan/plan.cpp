#include "render/plan/plan.h"

#include <algorithm>

#include "render/plan/features/features.h"

namespace render {
namespace {

// A technique for "auto": analytic where nothing carves shafts, else what the measured table knows to hold the demand.
ShaftSettings resolved_shafts(const SceneState& scene, const SceneNeeds& needs, const Quality& quality) {
  if (quality.shafts.technique != "auto") return quality.shafts;
  if (!needs.shafts) return {.technique = "closed-form"};
  const double pixels = static_cast<double>(scene.camera.width) * scene.camera.height;
  const auto chosen = choose_shafts(shaft_table(), quality.shaft_demand, pixels);
  return chosen.value_or(ShaftSettings{.technique = "interleaved"});
}

}  // namespace

bool Plan::has(const Feature& feature) const {
  return std::ranges::find(passes, &feature, &Pass::feature) != passes.end();
}

NotNeeded nothing_drawn(const PlanRequest& request) {
  return {request.needs.nothing_drawn + (request.over_video() ? ": the picture passes through" : "")};
}

Plan make_plan(const SceneState& scene, const Quality& quality, Target target) {
  const SceneNeeds needs = needs_of(scene);
  Plan plan{.target = target, .quality = quality, .passes = {}, .omitted = {}};
  plan.quality.shafts = resolved_shafts(scene, needs, quality);
  const PlanRequest request{scene, needs, plan.quality, target};
  for (const Feature* feature : features()) {
    Decision decision = feature->needed(request);
    if (auto* needed = std::get_if<Needed>(&decision)) {
      plan.passes.push_back({feature, std::move(needed->settings), std::move(needed->reason)});
    } else {
      plan.omitted.push_back({feature, std::move(std::get<NotNeeded>(decision).reason)});
    }
  }
  return plan;
}

}  // namespace render
