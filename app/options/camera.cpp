#include "app/options/camera.h"

#include <CLI/CLI.hpp>

namespace app {

void add_camera_options(CLI::App& command, CameraChoice& camera) {
  command.add_option("-c,--camera", camera.file,
                     "Camera file: OpenCV, ROS camera_info or Kalibr camchain; default: --fov, no distortion");
  command
      .add_option("--fov", camera.fov_deg,
                  "Horizontal field of view, degrees, instead of a camera file; default: 62 along the longer side")
      ->check(CLI::Range(1.0, 179.0))
      ->excludes("--camera");
  command.add_flag("--scale-camera", camera.scale, "Accept a camera file for another resolution of the same aspect");
}

}  // namespace app
