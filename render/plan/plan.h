#pragma once

#include <string>
#include <vector>

#include "render/plan/shaft_table.h"
#include "render/scene/scene_state.h"
#include "render/shafts/shaft_settings.h"

namespace render {

enum class PassKind { Upload, SunShadow, Objects, CascadedShadow, Shafts, Composite, Read };

struct Pass {
  PassKind kind;
  std::string name;      // as in `render --json`: "shadow", "objects", "shafts", "composite", ...
  std::string settings;  // for people
  std::string reason;    // why this scene needs it
};

struct Omission {
  std::string name;
  std::string reason;  // why this scene does not need it
};

// What one frame runs. A pass without a reason is not there.
struct Plan {
  std::vector<Pass> passes;
  std::vector<Omission> omitted;
  ShaftSettings shafts;  // resolved: technique is never "auto" here
  int shadow_map_size = 2048;
  bool anti_alias = true;
  bool quick_shadows = false;
  double render_scale = 1.0;

  bool has(PassKind kind) const;
};

// What the user or the scene file asks of the renderer.
struct Quality {
  ShaftSettings shafts;
  ShaftDemand shaft_demand;  // what "auto" has to hold, by the measured table
  int shadow_map_size = 2048;
  bool anti_alias = true;
  bool quick_shadows = false;  // soft shadows from fewer samples
  // (0, 1]: virtual things and medium are drawn in a picture that much smaller, and scaled up over the full real one.
  double render_scale = 1.0;
};

// What `scene` requires and why, and why not the rest. Needs no GL.
Plan make_plan(const SceneState& scene, const Quality& quality);

}  // namespace render
