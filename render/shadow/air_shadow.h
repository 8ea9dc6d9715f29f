#pragma once

#include "render/shadow/seen_air.h"
#include "render/shadow/sun_shadow.h"

namespace render {

// The sun's shadow maps once more, for the air: only over that part of it which is seen, so that their texels are finer
// than those of the maps for surfaces, which keep still while the view moves.
class AirShadow {
 public:
  // The maps to look for the air's casters in: its own, drawn again when the part that is seen has changed by more than
  // a step; or `shadow` (up to date) where their texels would be hardly finer. `depth`: as ShaftInputs has it.
  // Waits for the GL, and leaves framebuffer, viewport, program and depth state changed.
  const SunShadow& update(const SunShadow& shadow, const SceneState& scene, const View& view, GLuint depth,
                          GpuModels& models);

 private:
  SeenDepthPass seen_;
  SunShadow maps_;
};

}  // namespace render
