#include "render/composite/composite_pass.h"
#include "render/plan/features/features.h"
#include "render/plan/frame.h"

namespace render::feature {
namespace {

class Upload final : public FeaturePass {
 public:
  static Decision needed(const PlanRequest& request) {
    if (!request.over_video()) return NotNeeded{"there is no real picture"};
    if (!request.needs.nothing_drawn.empty()) return nothing_drawn(request);
    if (request.small_layers()) return NotNeeded{"smaller layers are laid over the real picture outside the GL"};
    return Needed{"the part of the picture that changes", "the real picture is composited"};
  }

  // Nothing goes to the GL where no layer changes anything: the region is empty then.
  void draw(Frame& frame) override {
    const PixelRect ideal = frame.drawn();
    const PixelRect changed = frame.lens != nullptr ? frame.lens->real_from_ideal(ideal) : ideal;
    frame.region = CompositePass::region(frame.in->format, changed);
    if (!frame.region.empty()) composite_.upload(*frame.in, frame.region);
    frame.composite = &composite_;
  }

 private:
  CompositePass composite_;
};

}  // namespace

constinit const Feature kUpload = feature_of<Upload>("upload");

}  // namespace render::feature
