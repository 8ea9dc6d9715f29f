#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ar/track/camera.h"

namespace calib {

// Reads OpenCV YAML/XML (camera_matrix, distortion_coefficients, image_width, image_height), ROS camera_info (the file
// of camera_calibration_parsers or the printed message, K and D or k and d), a Kalibr camchain (the first camera) or
// mrcal's .cameramodel (LENSMODEL_PINHOLE, LENSMODEL_OPENCV4, 5, 8, 12), told apart by their keys. Lens models:
// plumb_bob and radtan, rational_polynomial, equidistant and fisheye; where none is named, the number of coefficients
// says which. Coefficients that are all zero make LensModel::None. Throws ar::InputError that names file, line (YAML),
// key, what was found and what would be accepted.
ar::CameraModel read_camera_file(const std::filesystem::path& path);

// How a camera was calibrated and how well it is known.
struct CameraNote {
  std::string date;  // ISO 8601, UTC
  double rms_px = 0.0;
  double held_out_rms_px = 0.0;
  int views = 0;
  std::vector<double> sigma_intrinsics;  // of fx, fy, cx, cy, px
  std::vector<double> sigma_distortion;  // of each coefficient; 0 where it was held at zero
};

// The note that camera_text() wrote; nothing in files that were made elsewhere.
std::optional<CameraNote> read_camera_note(const std::filesystem::path& path);

enum class CameraFormat { OpenCv, Ros, Kalibr };

// A camera file with every digit kept, so that read_camera_file() gives the same camera again, and the note beside it
// under keys that other readers of these formats pass over. Throws std::runtime_error where the format has no word for
// the lens (Kalibr: four coefficients of plumb-bob or fisheye).
std::string camera_text(const ar::CameraModel& camera, CameraFormat format, const std::optional<CameraNote>& note);

// Writes OpenCV YAML. Throws std::runtime_error when the file cannot be written.
void write_camera_file(const std::filesystem::path& path, const ar::CameraModel& camera);

}  // namespace calib
