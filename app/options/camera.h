#pragma once

#include "app/process/camera_choice.h"

namespace CLI {
class App;
}

namespace app {

// --camera, or --fov; --scale-camera.
void add_camera_options(CLI::App& command, CameraChoice& camera);

}  // namespace app
