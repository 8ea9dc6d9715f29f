#pragma once

#include <filesystem>

#include "ar/track/camera.h"

namespace calib {

// Reads OpenCV YAML/XML (camera_matrix, distortion_coefficients, image_width ...), ROS camera_info YAML or a Kalibr
// camchain (the first camera), told apart by their keys. Throws ar::InputError that names file, line, key, what was
// found and what would be accepted.
ar::CameraModel read_camera_file(const std::filesystem::path& path);

}  // namespace calib
