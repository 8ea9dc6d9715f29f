#include "render/plan/frame_view.h"

namespace render {

const View& FrameView::update(const Camera& camera, double scale) {
  if (!camera.lens) {
    lens_.reset();
    view_ = ideal_view(camera, scale);
  } else if (!lens_ || map_ != camera.lens || scale_ != scale) {
    view_ = ideal_view(camera, scale);
    lens_.emplace(*camera.lens, view_);
  } else {
    look_from(camera, view_);
  }
  map_ = camera.lens;
  scale_ = scale;
  return view_;
}

}  // namespace render
