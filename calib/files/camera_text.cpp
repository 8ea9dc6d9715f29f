// Camera files in the words of OpenCV, ROS and Kalibr.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "calib/files/camera_file.h"

namespace calib {
namespace {

const char* ros_name(ar::LensModel lens) {
  switch (lens) {
    case ar::LensModel::None:
      return "none";
    case ar::LensModel::PlumbBob:
      return "plumb_bob";
    case ar::LensModel::Rational:
      return "rational_polynomial";
    case ar::LensModel::Fisheye:
      return "equidistant";
  }
  return "none";
}

// YAML's word for what is not known at all.
std::string number_or_inf(double v) {
  return std::isfinite(v) ? fmt::format("{:.6g}", v) : ".Inf";
}

std::string joined_or_inf(const std::vector<double>& values) {
  std::string text;
  for (double v : values) text += (text.empty() ? "" : ", ") + number_or_inf(v);
  return text;
}

std::string joined(const std::vector<double>& values, const char* form) {
  std::string text;
  for (double v : values) text += (text.empty() ? "" : ", ") + fmt::format(fmt::runtime(form), v);
  return text;
}

std::vector<double> numbers(const cv::Matx33d& m) {
  return {std::begin(m.val), std::end(m.val)};
}

// The note in each line's indentation. Kalibr keeps it in the camera's own map.
std::string note_text(const std::optional<CameraNote>& note, const std::string& indent) {
  if (!note) return "";
  return fmt::format(
      "{0}calibration_date: \"{1}\"\n{0}calibration_views: {2}\n{0}rms_px: {3}\n{0}held_out_rms_px: {4}\n"
      "{0}sigma_intrinsics: [ {5} ]\n{0}sigma_distortion: [ {6} ]\n",
      indent, note->date, note->views, number_or_inf(note->rms_px), number_or_inf(note->held_out_rms_px),
      joined_or_inf(note->sigma_intrinsics), joined_or_inf(note->sigma_distortion));
}

std::string opencv_matrix(const char* key, std::size_t rows, std::size_t cols, const std::vector<double>& values) {
  return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ {} ]\n", key, rows, cols,
                     joined(values, "{:.17g}"));
}

std::string ros_matrix(const char* key, std::size_t rows, std::size_t cols, const std::vector<double>& values) {
  return fmt::format("{}:\n  rows: {}\n  cols: {}\n  data: [{}]\n", key, rows, cols, joined(values, "{:.17g}"));
}

// Readers of OpenCV and ROS want a matrix even where there is no distortion.
std::vector<double> distortion_of(const ar::CameraModel& camera) {
  return camera.distortion.empty() ? std::vector<double>(5, 0.0) : camera.distortion;
}

std::string opencv_text(const ar::CameraModel& camera, const std::optional<CameraNote>& note) {
  const std::vector<double> distortion = distortion_of(camera);
  std::string text = "%YAML:1.0\n---\n";
  text += note_text(note, "");
  text += fmt::format("image_width: {}\nimage_height: {}\n", camera.width, camera.height);
  text += opencv_matrix("camera_matrix", 3, 3, numbers(camera.intrinsics));
  text += fmt::format("distortion_model: {}\n", ros_name(camera.lens));
  return text + opencv_matrix("distortion_coefficients", 1, distortion.size(), distortion);
}

std::string ros_text(const ar::CameraModel& camera, const std::optional<CameraNote>& note) {
  const cv::Matx33d& k = camera.intrinsics;
  const std::vector<double> distortion = distortion_of(camera);
  // camera_info knows no "none": a plumb bob of zeros is one.
  const char* const model = camera.lens == ar::LensModel::None ? "plumb_bob" : ros_name(camera.lens);
  std::string text = note_text(note, "");
  text += fmt::format("image_width: {}\nimage_height: {}\ncamera_name: camera\n", camera.width, camera.height);
  text += ros_matrix("camera_matrix", 3, 3, numbers(k));
  text += fmt::format("distortion_model: {}\n", model);
  text += ros_matrix("distortion_coefficients", 1, distortion.size(), distortion);
  text += ros_matrix("rectification_matrix", 3, 3, numbers(cv::Matx33d::eye()));
  return text + ros_matrix("projection_matrix", 3, 4,
                           {k(0, 0), k(0, 1), k(0, 2), 0.0, k(1, 0), k(1, 1), k(1, 2), 0.0, 0.0, 0.0, 1.0, 0.0});
}

std::string kalibr_text(const ar::CameraModel& camera, const std::optional<CameraNote>& note) {
  std::vector<double> distortion = camera.distortion;
  const bool k3_is_zero = camera.lens == ar::LensModel::PlumbBob && distortion.size() == 5 && distortion[4] == 0.0;
  if (k3_is_zero) distortion.resize(4);
  if (camera.lens == ar::LensModel::None) distortion.assign(4, 0.0);
  const cv::Matx33d& k = camera.intrinsics;
  if (distortion.size() != 4 || camera.lens == ar::LensModel::Rational || k(0, 1) != 0.0) {
    throw std::runtime_error(
        fmt::format("Kalibr has no lens of {} distortion terms ({})\ncalibrate with --lens plumb-bob-4 or fisheye, or "
                    "write the format opencv or ros",
                    camera.distortion.size(), ros_name(camera.lens)));
  }
  const char* const model = camera.lens == ar::LensModel::Fisheye ? "equidistant" : "radtan";
  return fmt::format(
      "cam0:\n{}  camera_model: pinhole\n  intrinsics: [{}]\n  distortion_model: {}\n"
      "  distortion_coeffs: [{}]\n  resolution: [{}, {}]\n",
      note_text(note, "  "), joined({k(0, 0), k(1, 1), k(0, 2), k(1, 2)}, "{:.17g}"), model,
      joined(distortion, "{:.17g}"), camera.width, camera.height);
}

}  // namespace

std::string camera_text(const ar::CameraModel& camera, CameraFormat format, const std::optional<CameraNote>& note) {
  switch (format) {
    case CameraFormat::OpenCv:
      return opencv_text(camera, note);
    case CameraFormat::Ros:
      return ros_text(camera, note);
    case CameraFormat::Kalibr:
      return kalibr_text(camera, note);
  }
  return "";
}

void write_camera_file(const std::filesystem::path& path, const ar::CameraModel& camera) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  if (!(out << camera_text(camera, CameraFormat::OpenCv, std::nullopt)) || !out.flush()) {
    throw std::runtime_error(
        fmt::format("camera file {}: cannot be written\n"
                    "is the folder there, writable, and its disk not full?",
                    path.string()));
  }
}

}  // namespace calib
