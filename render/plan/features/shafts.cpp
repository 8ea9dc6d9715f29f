#include <fmt/format.h>

#include <memory>

#include "render/plan/features/features.h"
#include "render/plan/frame.h"
#include "render/shafts/shaft_technique.h"

namespace render::feature {
namespace {

// "interleaved: steps 64, divisor 2"
std::string described(const ShaftSettings& shafts) {
  std::string text = shafts.technique;
  const ShaftTechniqueInfo* info = find_shaft_technique(shafts.technique);
  if (info == nullptr) return text;
  const char* separator = ": ";
  for (const ShaftParameter& parameter : info->parameters) {
    const double value = shafts.number(parameter.name);
    text += parameter.choices.empty() ? fmt::format("{}{} {:g}", separator, parameter.name, value)
                                      : fmt::format("{}{} {}", separator, parameter.name,
                                                    parameter.choices.at(static_cast<std::size_t>(value)));
    separator = ", ";
  }
  return text;
}

class Shafts final : public FeaturePass {
 public:
  static Decision needed(const PlanRequest& request) {
    const SceneNeeds& needs = request.needs;
    if (!needs.nothing_drawn.empty()) return nothing_drawn(request);
    if (!needs.medium) return NotNeeded{needs.no_shafts};
    return Needed{described(request.quality.shafts), needs.shafts
                                                         ? "a medium, and occluders that carve shafts into the sunlight"
                                                     : !needs.sun ? "a medium lit by the sky alone"
                                                                  : "a medium with nothing between it and the sun"};
  }

  void prepare(const Plan& plan) override {
    if (technique_ && settings_ == plan.quality.shafts) return;
    technique_ = make_shaft_technique(plan.quality.shafts);
    settings_ = plan.quality.shafts;
  }

  void draw(Frame& frame) override {
    frame.shafts = &technique_->draw(frame.shaft_inputs());
    frame.shafts_error = technique_->error();
  }

 private:
  std::unique_ptr<ShaftTechnique> technique_;
  ShaftSettings settings_;
};

}  // namespace

constinit const Feature kShafts = feature_of<Shafts>("shafts");

}  // namespace render::feature
