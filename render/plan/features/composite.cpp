#include "render/composite/composite_pass.h"
#include "render/composite/still_pass.h"
#include "render/plan/features/features.h"
#include "render/plan/frame.h"

namespace render::feature {
namespace {

class Composite final : public FeaturePass {
 public:
  static Decision needed(const PlanRequest& request) {
    switch (request.target) {
      case Target::Still:
        return Needed{"linear light, in floats", "virtual light is laid over the background"};
      case Target::Medium:
        return NotNeeded{"the medium alone is asked for"};
      case Target::Video:
        break;
    }
    if (!request.needs.nothing_drawn.empty()) return nothing_drawn(request);
    if (request.small_layers()) return NotNeeded{"smaller layers are laid over the real picture outside the GL"};
    return Needed{"linear light, the source's own encoding", "virtual light is laid over the real picture"};
  }

  void draw(Frame& frame) override {
    if (frame.plan.target == Target::Still) {
      frame.still->draw(frame.layers(), frame.scene.exposure);
    } else if (!frame.region.empty()) {
      frame.composite->draw(frame.layers(), frame.region);
    }
  }
};

}  // namespace

constinit const Feature kComposite = feature_of<Composite>("composite");

}  // namespace render::feature
