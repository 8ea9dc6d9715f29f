#pragma once

#include <filesystem>

#include "ar/track/camera.h"

namespace calib {

// Reads OpenCV YAML/XML (camera_matrix, distortion_coefficients, image_width, image_height), ROS camera_info (the file
// of camera_calibration_parsers or the printed message, K and D or k and d) or a Kalibr camchain (the first camera),
// told apart by their keys. Lens models: plumb_bob and radtan, rational_polynomial, equidistant and fisheye; where none
// is named, the number of coefficients says which. Coefficients that are all zero make LensModel::None. Throws
// ar::InputError that names file, line (YAML), key, what was found and what would be accepted.
ar::CameraModel read_camera_file(const std::filesystem::path& path);

// Writes OpenCV YAML, every digit kept, with the key `distortion_model` in ROS's words, so that read_camera_file()
// gives the same camera again. Throws std::runtime_error when the file cannot be written.
void write_camera_file(const std::filesystem::path& path, const ar::CameraModel& camera);

}  // namespace calib
