#include <fmt/format.h>

#include <optional>

#include "render/plan/features/features.h"
#include "render/plan/frame.h"
#include "render/surface/objects_pass.h"

namespace render::feature {
namespace {

std::string count(int n, const char* kind) {
  return fmt::format("{} {} thing{}", n, kind, n == 1 ? "" : "s");
}

std::string why_objects(const SceneNeeds& needs) {
  std::string reason;
  if (needs.virtual_instances > 0) reason = count(needs.virtual_instances, "virtual") + " to draw";
  if (needs.real_instances > 0) {
    reason +=
        (reason.empty() ? "" : ", ") + count(needs.real_instances, "real") +
        (needs.virtual_instances > 0 ? " to take shadows and to hide what is behind" : " at which the medium ends");
  }
  return reason;
}

class Objects final : public FeaturePass {
 public:
  static Decision needed(const PlanRequest& request) {
    if (!request.needs.nothing_drawn.empty()) return nothing_drawn(request);
    if (!request.needs.objects) return NotNeeded{"the scene has no objects"};
    return Needed{request.quality.anti_alias ? "4 samples a pixel" : "1 sample a pixel", why_objects(request.needs)};
  }

  void prepare(const Plan& plan) override {
    const Quality& quality = plan.quality;
    if (pass_ && anti_alias_ == quality.anti_alias && quick_shadows_ == quality.quick_shadows) return;
    pass_.emplace(quality.anti_alias ? 4 : 1, quality.quick_shadows);
    anti_alias_ = quality.anti_alias;
    quick_shadows_ = quality.quick_shadows;
  }

  void draw(Frame& frame) override {
    frame.objects = &pass_->draw(frame.scene, frame.view, *frame.shadow, frame.models);
  }

 private:
  std::optional<ObjectsPass> pass_;
  bool anti_alias_ = true;
  bool quick_shadows_ = false;
};

}  // namespace

constinit const Feature kObjects = feature_of<Objects>("objects");

}  // namespace render::feature
