#include <thread>

#include "render/composite/composite_pass.h"
#include "render/composite/quick_composite.h"
#include "render/plan/features/features.h"
#include "render/plan/frame.h"

namespace render::feature {
namespace {

class Overlay final : public FeaturePass {
 public:
  static Decision needed(const PlanRequest& request) {
    if (!request.over_video()) return NotNeeded{"there is no real picture"};
    if (!request.needs.nothing_drawn.empty()) return nothing_drawn(request);
    if (!request.small_layers()) return NotNeeded{"the layers are as large as the picture"};
    return Needed{"linear light, by the CPU", "the smaller layer is scaled up over the real picture"};
  }

  void draw(Frame& frame) override {
    if (frame.merged == nullptr) return copy_picture(*frame.in, *frame.out);
    composite_.draw(frame.scene.camera, frame.view, *frame.merged, *frame.in, *frame.out);
  }

 private:
  QuickComposite composite_{static_cast<int>(std::thread::hardware_concurrency())};
};

}  // namespace

constinit const Feature kOverlay = feature_of<Overlay>("overlay");

}  // namespace render::feature
