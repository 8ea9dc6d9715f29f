#pragma once

#include <memory>
#include <optional>

#include "render/composite/ideal_view.h"

namespace render {

// The ideal picture of a camera from frame to frame: what its lens needs is computed anew only when lens or size
// change.
class FrameView {
 public:
  // As ideal_view(). Valid until the next call.
  const View& update(const Camera& camera, double scale);
  // Of the last update. Null: the camera has no lens map.
  const LensLookup* lens() const { return lens_ ? &*lens_ : nullptr; }

 private:
  std::shared_ptr<const LensMap> map_;  // what the rest was made from
  double scale_ = 1.0;
  std::optional<LensLookup> lens_;
  View view_;
};

}  // namespace render
