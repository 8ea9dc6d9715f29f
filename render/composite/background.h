#pragma once

#include "render/images/image_io.h"
#include "render/scene/scene_state.h"

namespace render {

// The sky that a camera sees behind everything, in cd/m2, with the sun's disc where it has a size (its luminance is its
// illuminance over the disc's solid angle; pixels on the rim are covered in part). Black without a sky. Evaluated at
// each pixel's centre, through the lens where there is one; pixels that look nowhere are black.
LinearImage sky_background(const SceneState& scene);

}  // namespace render
