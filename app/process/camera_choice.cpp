#include "app/process/camera_choice.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "ar/error.h"
#include "calib/files/camera_file.h"
#include "render/base/angles.h"

namespace app {
namespace {

// Phones' main cameras film at 60 to 70 degrees along the longer side, webcams at 55 to 65.
constexpr double kUsualLongFovDeg = 62.0;

double aspect_of_pixels(const ar::SourceInfo& source) {
  const ar::Rational& aspect = source.sample_aspect;
  return aspect.num > 0 && aspect.den > 0 ? static_cast<double>(aspect.num) / aspect.den : 1.0;
}

// Horizontal field of view when that of the longer side is the usual one.
double usual_horizontal_fov_rad(const ar::SourceInfo& source) {
  const double width = source.format.width * aspect_of_pixels(source);
  const double longer = std::max<double>(width, source.format.height);
  return 2.0 * std::atan(width / longer * std::tan(0.5 * kUsualLongFovDeg * render::kRadPerDeg));
}

ar::CameraModel from_file(const CameraChoice& choice, const ar::SourceInfo& source) {
  ar::CameraModel camera = calib::read_camera_file(*choice.file);
  const auto& format = source.format;
  if (camera.width == format.width && camera.height == format.height) return camera;
  const std::string what = fmt::format("{}: is for {}x{}, but {} is {}x{}", choice.file->string(), camera.width,
                                       camera.height, source.name, format.width, format.height);
  if (!choice.scale) {
    throw ar::InputError(what +
                         "\ngive the camera file of that resolution, or --scale-camera when the same lens "
                         "filmed the same field of view");
  }
  try {
    camera = ar::scaled(camera, format.width, format.height);
  } catch (const std::runtime_error& error) {
    throw ar::InputError(what + ", another aspect: scaling would be wrong\ngive the camera file of that resolution");
  }
  spdlog::info("camera scaled to {}x{}", format.width, format.height);
  return camera;
}

}  // namespace

ar::CameraModel choose_camera(const CameraChoice& choice, const ar::SourceInfo& source) {
  if (choice.file) {
    ar::CameraModel camera = from_file(choice, source);
    spdlog::info("camera {}: focal length {:.1f} x {:.1f} px", choice.file->string(), camera.intrinsics(0, 0),
                 camera.intrinsics(1, 1));
    return camera;
  }
  const double fov_rad = choice.fov_deg ? *choice.fov_deg * render::kRadPerDeg : usual_horizontal_fov_rad(source);
  const std::string assumed = fmt::format("no lens distortion, {:.1f} degrees across", fov_rad / render::kRadPerDeg);
  if (choice.fov_deg) {
    spdlog::info("camera assumed: {} (--fov)", assumed);
  } else {
    spdlog::warn("neither --camera nor --fov: assumed {}; positions are off as far as that is wrong", assumed);
  }
  ar::CameraModel camera =
      ar::camera_from_horizontal_fov(source.format.width, source.format.height, fov_rad, aspect_of_pixels(source));
  camera.origin = assumed;
  return camera;
}

}  // namespace app
