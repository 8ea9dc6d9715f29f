#include <fmt/format.h>

#include "render/plan/features/features.h"
#include "render/plan/frame.h"
#include "render/shadow/sun_shadow.h"

namespace render::feature {
namespace {

class Shadow final : public FeaturePass {
 public:
  static Decision needed(const PlanRequest& request) {
    const SceneNeeds& needs = request.needs;
    if (!needs.nothing_drawn.empty()) return nothing_drawn(request);
    if (!needs.sun) return NotNeeded{"no sunlight: the sun is down or has no illuminance"};
    if (!needs.occluders) return NotNeeded{"nothing in the scene casts a shadow"};
    if (needs.virtual_instances == 0 && !needs.shafts) {
      return NotNeeded{"no shadow falls on virtual things or into the medium"};
    }
    return Needed{
        fmt::format("{0} x {0} texels, drawn again only when the sun, an occluder or the region they shade changes",
                    request.quality.shadow_map_size),
        fmt::format("{} and things that cast shadows", sun_of(request.scene).is_moon ? "moonlight" : "sunlight")};
  }

  void draw(Frame& frame) override {
    shadow_.update(frame.scene, frame.view, frame.plan.quality.shadow_map_size, frame.models);
    frame.shadow = &shadow_;
  }

 private:
  SunShadow shadow_;
};

}  // namespace

constinit const Feature kShadow = feature_of<Shadow>("shadow");

}  // namespace render::feature
