#pragma once

#include "render/plan/shaft_table.h"
#include "render/shafts/shaft_settings.h"

namespace render {

// What a plan's picture is made for.
enum class Target {
  Video,   // laid over a real picture, in that picture's own encoding
  Still,   // before the sky, as linear light
  Medium,  // what the medium alone adds and lets through
};

// What the user or the scene file asks of the renderer.
struct Quality {
  ShaftSettings shafts;
  ShaftDemand shaft_demand;  // what "auto" has to hold, by the measured table
  int shadow_map_size = 2048;
  bool anti_alias = true;
  bool quick_shadows = false;  // soft shadows from fewer samples
  // (0, 1]: over video, virtual things and medium are drawn in a picture that much smaller, and scaled up over the full
  // real one.
  double render_scale = 1.0;
};

}  // namespace render
