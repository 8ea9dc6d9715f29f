#pragma once

#include "render/composite/objects_pass.h"

namespace render {

// The part of the picture that virtual things or their sun shadows on real things can touch; a little generous.
PixelRect touched_rect(const SceneState& scene, const View& view);

}  // namespace render
