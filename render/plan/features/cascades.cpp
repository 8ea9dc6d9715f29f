#include "render/shadow/cascades.h"

#include <fmt/format.h>

#include "render/plan/features/features.h"
#include "render/plan/frame.h"

namespace render::feature {
namespace {

class Cascades final : public FeaturePass {
 public:
  static Decision needed(const PlanRequest& request) {
    const SceneNeeds& needs = request.needs;
    if (!needs.nothing_drawn.empty()) return nothing_drawn(request);
    if (!needs.shafts) return NotNeeded{needs.no_shafts};
    const ShaftSettings& shafts = request.quality.shafts;
    const ShaftTechniqueInfo* info = find_shaft_technique(shafts.technique);
    if (info == nullptr || !info->limited_by_shadow_resolution) {
      return NotNeeded{shafts.technique + " does not show the shadow map's texels"};
    }
    if (info->soft_sun(shafts)) return NotNeeded{"shafts that soften by the sun's disc hide the texels"};
    return Needed{fmt::format("{0} x {0} texels over the medium that is seen, where that is much less than all; parted "
                              "by distance where they would look coarse near the eye",
                              request.quality.shadow_map_size),
                  fmt::format("{} shows the shadow map's texels", shafts.technique)};
  }

  void draw(Frame& frame) override {
    const GLuint depth = frame.objects != nullptr ? frame.objects->depth : 0;
    frame.cascades = shadow_.update(*frame.shadow, frame.scene, frame.view, depth, frame.models);
  }

 private:
  CascadedShadow shadow_;
};

}  // namespace

constinit const Feature kCascades = feature_of<Cascades>("cascades");

}  // namespace render::feature
