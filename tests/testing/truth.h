#pragma once

#include "render/scene/scene_state.h"
#include "render/shafts/reference/shaft_reference.h"

namespace render::test {

// What the reference finds for the depth that the rig draws of the scene's own camera.
ReferencePicture truth_of(const SceneState& scene, ReferenceSky sky = ReferenceSky::Open);

}  // namespace render::test
