#pragma once

#include <filesystem>
#include <optional>

namespace CLI {
class App;
}

namespace app {

struct CameraChoice {
  std::optional<std::filesystem::path> file;
  std::optional<double> fov_deg;  // horizontal, of the upright picture
  bool scale = false;             // accept a file for another size of the same aspect
};

// --camera, or --fov; --scale-camera.
void add_camera_options(CLI::App& command, CameraChoice& camera);

}  // namespace app
