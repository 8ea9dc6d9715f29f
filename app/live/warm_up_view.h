#pragma once

#include "app/scene_file/scene_file.h"
#include "ar/track/pose.h"
#include "render/base/box.h"

namespace app {

// What the scene's virtual instances fill, each by its model's bounds as it is placed; 2 m about the origin where there
// are none.
render::Box bounds_of_virtual_instances(const SceneFile& scene);

// A camera that has them all in view, from the south and a little above: world_from_camera for pictures that are drawn
// before there is a frame.
ar::Rigid3 pose_with_all_in_view(const SceneFile& scene);

}  // namespace app
