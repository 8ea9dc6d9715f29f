#pragma once

#include "render/surface/objects_pass.h"

namespace render {

// The part of the picture that virtual things can cover, and the part that they or their sun shadows on real things
// can touch; both a little generous.
PixelRect covered_rect(const SceneState& scene, const View& view);
PixelRect touched_rect(const SceneState& scene, const View& view);

}  // namespace render
