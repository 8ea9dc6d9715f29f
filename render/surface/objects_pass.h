#pragma once

#include <GLES3/gl31.h>

#include <memory>

#include "render/base/rectangle.h"
#include "render/gl/gpu_model.h"
#include "render/scene/scene_state.h"
#include "render/scene/view.h"
#include "render/shadow/sun_shadow.h"

namespace render {

// The objects pass's ideal pinhole picture: real * M + A, linear and pre-exposed. Row 0 of the textures is the
// picture's top row. Owned by the pass; valid until its next draw.
struct ObjectsPicture {
  GLuint added = 0;       // RGBA16F: rgb is A; a is the part of the pixel that virtual things leave uncovered
  GLuint multiplier = 0;  // M: RGB10_A2, rgb in [0, 1]
  GLuint depth = 0;       // DEPTH_COMPONENT32F, window depth as View says; 1 where nothing is. Whole picture.
  int width = 0;
  int height = 0;
  PixelRect touched;  // outside it M = 1 and A = 0 (the textures hold these values there)
};

// Draws real surfaces (depth, and the shadow on them, once a pixel) and virtual objects (multisampled).
class ObjectsPass {
 public:
  // `samples` 1: no anti-aliasing. `quick_shadows`: coarser penumbras in less time.
  explicit ObjectsPass(int samples = 4, bool quick_shadows = false);
  ~ObjectsPass();
  ObjectsPass(const ObjectsPass&) = delete;
  ObjectsPass& operator=(const ObjectsPass&) = delete;

  // `shadow` must be up to date with `scene`. Leaves framebuffer, viewport, program, blend and depth state changed.
  const ObjectsPicture& draw(const SceneState& scene, const View& view, const SunShadow& shadow, GpuModels& models);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace render
