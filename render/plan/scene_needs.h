#pragma once

#include <string>

#include "render/scene/scene_state.h"

namespace render {

// What a scene has that features may be needed for.
struct SceneNeeds {
  int virtual_instances = 0;
  int real_instances = 0;
  bool sun = false;
  bool occluders = false;
  bool objects = false;      // instances to draw, or at which the medium ends
  bool medium = false;       // one that extinguishes light
  bool shafts = false;       // occluders that can shadow the medium
  bool translucent = false;  // and among them some that tint it

  std::string nothing_drawn;  // why nothing virtual is drawn at all; empty: something is
  std::string no_shafts;      // why no occluder carves shafts; empty: some do
};

// Needs no GL.
SceneNeeds needs_of(const SceneState& scene);

}  // namespace render
