#pragma once

#include <memory>
#include <string>
#include <variant>

#include "render/plan/quality.h"
#include "render/plan/scene_needs.h"
#include "render/scene/scene_state.h"

namespace render {

struct Frame;
struct Plan;

// What features decide by. Plain values, borrowed for the call.
struct PlanRequest {
  const SceneState& scene;
  const SceneNeeds& needs;
  const Quality& quality;  // the shafts' technique is resolved: never "auto"
  Target target;

  bool over_video() const { return target == Target::Video; }
  // Layers smaller than the picture that they are laid over.
  bool small_layers() const { return over_video() && quality.render_scale < 1.0; }
};

// Both for people: with which settings a feature is drawn and why, or why it is not.
struct Needed {
  std::string settings;
  std::string reason;
};
struct NotNeeded {
  std::string reason;
};
using Decision = std::variant<Needed, NotNeeded>;

// That nothing virtual is drawn, and what becomes of the picture. For scenes with needs.nothing_drawn.
NotNeeded nothing_drawn(const PlanRequest& request);

// A feature at work, with what it keeps in the GL from frame to frame. One per renderer, made when first in a plan.
class FeaturePass {
 public:
  virtual ~FeaturePass() = default;
  // Makes what the plan's settings ask for, before the frame's first pass. Not timed.
  virtual void prepare(const Plan& /*plan*/) {}
  // Takes what features before it left in the frame, and leaves there what it draws.
  virtual void draw(Frame& frame) = 0;
};

// One thing that a frame may need.
struct Feature {
  const char* name;  // as in `render --json` and `explain`: "shadow", "objects", "shafts", "composite", ...
  Decision (*needed)(const PlanRequest&);  // needs no GL
  std::unique_ptr<FeaturePass> (*make)();  // on the GL context's thread
};

// For a FeaturePass with `static Decision needed(const PlanRequest&)`.
template <typename Pass>
constexpr Feature feature_of(const char* name) {
  return {name, &Pass::needed, []() -> std::unique_ptr<FeaturePass> { return std::make_unique<Pass>(); }};
}

}  // namespace render
