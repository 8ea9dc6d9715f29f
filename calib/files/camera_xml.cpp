// OpenCV XML as RawCamera. OpenCV's reader keeps no line numbers, so that messages name file and key only.

#include <fmt/format.h>

#include <opencv2/core/persistence.hpp>

#include "ar/error.h"
#include "calib/files/raw_camera.h"

namespace calib {
namespace {

std::vector<double> matrix(const cv::FileNode& node, const std::string& file, const char* key) {
  cv::Mat values;
  try {
    node >> values;
    values.convertTo(values, CV_64F);
  } catch (const cv::Exception&) {
    refuse(file, key, "no matrix", "an opencv-matrix");
  }
  if (values.empty()) return {};
  values = values.reshape(1, 1);
  return {values.begin<double>(), values.end<double>()};
}

int positive(const cv::FileNode& node, const std::string& file, const char* key) {
  if (!node.isInt() || static_cast<int>(node) <= 0) {
    refuse(file, key, node.empty() ? "no such key" : "no positive whole number", "the calibrated picture's size in px");
  }
  return static_cast<int>(node);
}

cv::FileNode first_of(const cv::FileStorage& storage, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (!storage[name].empty()) return storage[name];
  }
  return {};
}

}  // namespace

RawCamera read_xml(const std::filesystem::path& path, const std::string& text) {
  const std::string file = path.string();
  cv::FileStorage storage;
  try {
    storage.open(text, cv::FileStorage::READ | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_XML);
  } catch (const cv::Exception& error) {
    throw ar::InputError(fmt::format("camera file {}: no OpenCV XML: {}\nis it complete?", file, error.err));
  }
  RawCamera raw;
  raw.width = positive(first_of(storage, {"image_width", "image_Width"}), file, "image_width");
  raw.height = positive(first_of(storage, {"image_height", "image_Height"}), file, "image_height");
  raw.intrinsics_where = raw.distortion_where = raw.model_where = file;
  const cv::FileNode intrinsics = first_of(storage, {"camera_matrix", "Camera_Matrix", "cameraMatrix"});
  if (intrinsics.empty()) refuse(file, "camera_matrix", "no such key", "a 3 x 3 opencv-matrix");
  raw.intrinsics = matrix(intrinsics, file, "camera_matrix");
  const cv::FileNode distortion =
      first_of(storage, {"distortion_coefficients", "Distortion_Coefficients", "distCoeffs", "dist_coeffs"});
  if (!distortion.empty()) raw.distortion = matrix(distortion, file, "distortion_coefficients");
  const cv::FileNode model = storage["distortion_model"];
  if (model.isString()) raw.model = static_cast<std::string>(model);
  const cv::FileNode fisheye = first_of(storage, {"fisheye_model", "fisheyeModel"});
  if (fisheye.isInt() && static_cast<int>(fisheye) != 0) raw.model = "fisheye";
  return raw;
}

}  // namespace calib
