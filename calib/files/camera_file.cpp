#include "calib/files/camera_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "ar/error.h"
#include "calib/files/raw_camera.h"

namespace calib {
namespace {

const char* const kModels = "plumb_bob, radtan, rational_polynomial, equidistant, fisheye";

std::string read_text(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) {
    throw ar::InputError(fmt::format("camera file {}: is a folder\ngive the file itself", path.string()));
  }
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf())) {
    throw ar::InputError(
        fmt::format("camera file {}: cannot be read or is empty\n"
                    "give an OpenCV, ROS camera_info, Kalibr camchain or mrcal .cameramodel file",
                    path.string()));
  }
  return text.str();
}

// Five, eight ... numbers mean what OpenCV's order says; a fisheye's four cannot be told from a plumb bob's and must be
// named.
ar::LensModel model_by_count(const RawCamera& raw) {
  switch (raw.distortion.size()) {
    case 0:
      return ar::LensModel::None;
    case 4:
    case 5:
      return ar::LensModel::PlumbBob;
    case 8:
    case 12:
    case 14:
      return ar::LensModel::Rational;
    default:
      refuse(raw.distortion_where, "distortion coefficients", fmt::format("{} numbers", raw.distortion.size()),
             "4, 5, 8, 12 or 14 in OpenCV's order, or none");
  }
}

ar::LensModel model_by_name(const RawCamera& raw) {
  const std::string& name = *raw.model;
  if (name == "plumb_bob" || name == "radtan") return ar::LensModel::PlumbBob;
  if (name == "rational_polynomial") return ar::LensModel::Rational;
  if (name == "equidistant" || name == "fisheye") return ar::LensModel::Fisheye;
  if (name == "none" || name.empty()) return ar::LensModel::None;
  refuse(raw.model_where, "distortion_model", "'" + name + "'", kModels);
}

void set_lens(const RawCamera& raw, ar::CameraModel& camera) {
  const ar::LensModel named = raw.model ? model_by_name(raw) : model_by_count(raw);
  const bool all_zero = std::all_of(raw.distortion.begin(), raw.distortion.end(), [](double k) { return k == 0.0; });
  // A fisheye's zeros are no pinhole: its angle, not its tangent, is proportional to the radius.
  const bool pinhole = all_zero && named != ar::LensModel::Fisheye;
  if (pinhole) return;
  const std::size_t count = raw.distortion.size();
  const auto demand = [&](bool fits, const char* accepted) {
    if (!fits) {
      refuse(raw.distortion_where, "distortion coefficients",
             fmt::format("{} numbers for {}", count, raw.model.value_or("this model")), accepted);
    }
  };
  if (named == ar::LensModel::None) demand(false, "none, or a model's name");
  if (named == ar::LensModel::PlumbBob) demand(count == 4 || count == 5, "k1, k2, p1, p2 and perhaps k3");
  if (named == ar::LensModel::Rational) {
    demand(count == 8 || count == 12 || count == 14, "8, 12 or 14 in OpenCV's order");
  }
  if (named == ar::LensModel::Fisheye) demand(count == 4, "k1, k2, k3, k4");
  camera.lens = named;
  camera.distortion = raw.distortion;
}

void set_intrinsics(const RawCamera& raw, ar::CameraModel& camera) {
  if (raw.intrinsics.size() != 9) {
    refuse(raw.intrinsics_where, "camera matrix", fmt::format("{} numbers", raw.intrinsics.size()), "3 x 3 numbers");
  }
  std::copy(raw.intrinsics.begin(), raw.intrinsics.end(), camera.intrinsics.val);
  const cv::Matx33d& k = camera.intrinsics;
  const std::string found = fmt::format("[{}]", fmt::join(raw.intrinsics, ", "));
  if (!(k(0, 0) > 0.0) || !(k(1, 1) > 0.0)) {
    refuse(raw.intrinsics_where, "camera matrix", found,
           "positive focal lengths fx and fy (an uncalibrated camera has 0)");
  }
  if (k(1, 0) != 0.0 || k(2, 0) != 0.0 || k(2, 1) != 0.0 || k(2, 2) != 1.0) {
    refuse(raw.intrinsics_where, "camera matrix", found, "fx, s, cx; 0, fy, cy; 0, 0, 1");
  }
}

bool looks_like_xml(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  return first != std::string::npos && text[first] == '<';
}

}  // namespace

std::optional<CameraNote> read_camera_note(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  if (looks_like_xml(text) || looks_like_mrcal(text)) return std::nullopt;
  return read_note(path, text);
}

void refuse(const std::string& where, const std::string& key, const std::string& found, const std::string& accepted) {
  throw ar::InputError(fmt::format("{}: {}: found {}; accepted: {}", where, key, found, accepted));
}

ar::CameraModel read_camera_file(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  const RawCamera raw = looks_like_xml(text)     ? read_xml(path, text)
                        : looks_like_mrcal(text) ? read_mrcal(path, text)
                                                 : read_yaml(path, text);
  ar::CameraModel camera;
  camera.width = raw.width;
  camera.height = raw.height;
  camera.origin = path.string();
  set_intrinsics(raw, camera);
  set_lens(raw, camera);
  return camera;
}

}  // namespace calib
