#include <fmt/format.h>

#include "render/composite/merge_pass.h"
#include "render/plan/features/features.h"
#include "render/plan/frame.h"

namespace render::feature {
namespace {

class Merge final : public FeaturePass {
 public:
  static Decision needed(const PlanRequest& request) {
    if (!request.over_video()) return NotNeeded{"there is no real picture"};
    if (!request.needs.nothing_drawn.empty()) return nothing_drawn(request);
    if (!request.small_layers()) return NotNeeded{"the layers are as large as the picture"};
    return Needed{
        "objects and medium in one layer",
        fmt::format("they are drawn at {:g} of the picture's width and height", request.quality.render_scale)};
  }

  void draw(Frame& frame) override {
    frame.region = frame.drawn();
    const bool wide_gamut = frame.in->format.matrix == ColorMatrix::Bt2020;
    if (!frame.region.empty()) merge_.draw(frame.layers(), frame.region, wide_gamut);
    frame.merge = &merge_;
  }

 private:
  MergePass merge_;
};

}  // namespace

constinit const Feature kMerge = feature_of<Merge>("merge");

}  // namespace render::feature
