#include "calib/solve/lens_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "render/base/check.h"

namespace calib {
namespace {

const std::vector<std::string> kNames{"pinhole", "plumb-bob-2", "plumb-bob-4", "fisheye", "plumb-bob-5", "rational"};

}  // namespace

const std::vector<std::string>& lens_choice_names() {
  return kNames;
}

const std::string& to_string(LensChoice choice) {
  return kNames[static_cast<std::size_t>(choice)];
}

LensChoice lens_choice_from(const std::string& name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) {
    throw std::runtime_error(fmt::format("unknown lens model '{}'\nknown: {}", name, fmt::join(kNames, ", ")));
  }
  return static_cast<LensChoice>(found - kNames.begin());
}

std::vector<std::string> intrinsics_names(LensChoice choice) {
  switch (choice) {
    case LensChoice::Pinhole:
      return {"fx", "fy", "cx", "cy"};
    case LensChoice::PlumbBob2:
      return {"fx", "fy", "cx", "cy", "k1", "k2"};
    case LensChoice::PlumbBob4:
      return {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2"};
    case LensChoice::Fisheye4:
      return {"fx", "fy", "cx", "cy", "k1", "k2", "k3", "k4"};
    case LensChoice::PlumbBob5:
      return {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3"};
    case LensChoice::Rational8:
      return {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
  }
  return {};
}

int intrinsics_count(LensChoice choice) {
  // Asked for each corner: no names are made for it.
  switch (choice) {
    case LensChoice::Pinhole:
      return 4;
    case LensChoice::PlumbBob2:
      return 6;
    case LensChoice::PlumbBob4:
    case LensChoice::Fisheye4:
      return 8;
    case LensChoice::PlumbBob5:
      return 9;
    case LensChoice::Rational8:
      return 12;
  }
  return 0;
}

ar::CameraModel camera_of(LensChoice choice, const std::vector<double>& v, int width, int height) {
  CHECK(static_cast<int>(v.size()) == intrinsics_count(choice));
  ar::CameraModel camera;
  camera.width = width;
  camera.height = height;
  camera.intrinsics = {v[0], 0.0, v[2], 0.0, v[1], v[3], 0.0, 0.0, 1.0};
  camera.distortion.assign(v.begin() + 4, v.end());
  if (choice == LensChoice::Pinhole) return camera;
  if (choice == LensChoice::PlumbBob2) camera.distortion.resize(4, 0.0);
  camera.lens = choice == LensChoice::Fisheye4    ? ar::LensModel::Fisheye
                : choice == LensChoice::Rational8 ? ar::LensModel::Rational
                                                  : ar::LensModel::PlumbBob;
  return camera;
}

std::vector<double> intrinsics_of(LensChoice choice, const ar::CameraModel& camera) {
  const cv::Matx33d& k = camera.intrinsics;
  std::vector<double> v{k(0, 0), k(1, 1), k(0, 2), k(1, 2)};
  v.insert(v.end(), camera.distortion.begin(), camera.distortion.end());
  v.resize(static_cast<std::size_t>(intrinsics_count(choice)), 0.0);
  return v;
}

LensChoice lens_choice_of(const ar::CameraModel& camera) {
  switch (camera.lens) {
    case ar::LensModel::None:
      return LensChoice::Pinhole;
    case ar::LensModel::Fisheye:
      return LensChoice::Fisheye4;
    case ar::LensModel::PlumbBob:
      return camera.distortion.size() == 4 ? LensChoice::PlumbBob4 : LensChoice::PlumbBob5;
    case ar::LensModel::Rational:
      break;
  }
  if (camera.distortion.size() > 8) {
    throw std::runtime_error(
        fmt::format("camera {}: thin prism and tilt terms are not supported here\n"
                    "accepted: up to eight distortion terms",
                    camera.origin));
  }
  return LensChoice::Rational8;
}

}  // namespace calib
