#include "render/composite/composite_pass.h"
#include "render/composite/merge_pass.h"
#include "render/composite/still_pass.h"
#include "render/plan/features/features.h"
#include "render/plan/frame.h"

namespace render::feature {
namespace {

class Read final : public FeaturePass {
 public:
  static Decision needed(const PlanRequest& request) {
    switch (request.target) {
      case Target::Still:
        return Needed{"all of the picture", "the result leaves the GL"};
      case Target::Medium:
        return NotNeeded{"the medium alone is asked for"};
      case Target::Video:
        break;
    }
    if (!request.needs.nothing_drawn.empty()) return nothing_drawn(request);
    return Needed{request.small_layers() ? "the one layer of objects and medium"
                                         : "the part of the picture that changes; the rest is copied",
                  "the result leaves the GL"};
  }

  void draw(Frame& frame) override {
    if (frame.plan.target == Target::Still) {
      frame.linear = frame.still->read();
    } else if (frame.merge != nullptr) {
      if (!frame.region.empty()) frame.merged = &frame.merge->read();
    } else if (frame.region.empty()) {
      copy_picture(*frame.in, *frame.out);
    } else {
      frame.composite->read(*frame.in, *frame.out, frame.region);
    }
  }
};

}  // namespace

constinit const Feature kRead = feature_of<Read>("read");

}  // namespace render::feature
