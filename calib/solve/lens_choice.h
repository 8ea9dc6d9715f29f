#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "ar/track/camera.h"

namespace calib {

// Lens models that are solved for, with their numbers of distortion terms, simplest first.
enum class LensChoice {
  Pinhole,    // none
  PlumbBob2,  // k1, k2
  PlumbBob4,  // k1, k2, p1, p2
  Fisheye4,   // k1 ... k4 of the angle (equidistant)
  PlumbBob5,  // k1, k2, p1, p2, k3
  Rational8   // k1, k2, p1, p2, k3 ... k6
};

// "pinhole", "plumb-bob-2", "plumb-bob-4", "fisheye", "plumb-bob-5", "rational".
const std::vector<std::string>& lens_choice_names();
const std::string& to_string(LensChoice choice);
// Throws std::runtime_error that lists the names.
LensChoice lens_choice_from(const std::string& name);

// fx, fy, cx, cy and the distortion terms: 4 to 12.
int intrinsics_count(LensChoice choice);
// "fx", "fy", "cx", "cy", "k1" ...
std::vector<std::string> intrinsics_names(LensChoice choice);

// The numbers that are solved for, as a camera model and back. camera_of() leaves `origin` empty.
ar::CameraModel camera_of(LensChoice choice, const std::vector<double>& intrinsics, int width, int height);
std::vector<double> intrinsics_of(LensChoice choice, const ar::CameraModel& camera);

// Which choice a camera model is an instance of. Throws std::runtime_error for one with thin prism or tilt terms.
LensChoice lens_choice_of(const ar::CameraModel& camera);

}  // namespace calib
