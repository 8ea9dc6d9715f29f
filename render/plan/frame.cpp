#include "render/plan/frame.h"

#include "render/plan/screen_region.h"

namespace render {

ShaftInputs Frame::shaft_inputs() const {
  const PixelRect seen = medium_region(view, *scene.medium);
  return {.scene = scene,
          .view = view,
          .depth = objects != nullptr ? objects->depth : 0,
          .shadow = *shadow,
          .medium = cascades,
          .region_px = {seen.x, seen.y, seen.width, seen.height},
          .with_distance = plan.target == Target::Medium || lens != nullptr};
}

CompositeLayers Frame::layers() const {
  return {.objects = objects, .shafts = shafts, .lens = lens, .view = &view};
}

PixelRect Frame::drawn() const {
  PixelRect ideal;
  if (objects != nullptr) ideal = objects->touched;
  if (shafts != nullptr) ideal = united(ideal, medium_region(view, *scene.medium));
  return ideal;
}

}  // namespace render
