#pragma once

#include <string>
#include <vector>

#include "render/plan/feature.h"
#include "render/plan/quality.h"

namespace render {

struct Pass {
  const Feature* feature;
  std::string settings;  // for people
  std::string reason;    // why this scene needs it
};

struct Omission {
  const Feature* feature;
  std::string reason;  // why this scene does not need it
};

// What one frame runs: each of features() is either a pass or an omission.
struct Plan {
  Target target = Target::Video;
  Quality quality;           // as asked, but the shafts' technique is never "auto" here
  std::vector<Pass> passes;  // in the order in which they run
  std::vector<Omission> omitted;

  bool has(const Feature& feature) const;
};

// What `scene` requires for that target and why, and why not the rest. Needs no GL.
Plan make_plan(const SceneState& scene, const Quality& quality, Target target);

}  // namespace render
