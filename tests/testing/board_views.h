#pragma once

#include <cstdint>

#include "ar/track/camera.h"
#include "calib/boards/board.h"
#include "calib/boards/observation.h"
#include "calib/solve/lens_choice.h"

namespace calib::testing {

// A camera of that lens with distortion such as real ones have: 1280 x 960 px, its principal point off the middle.
ar::CameraModel true_camera(LensChoice lens);

struct ViewSet {
  int views = 12;
  double most_tilt_rad = 0.7;
  double noise_px = 0.1;
  std::uint64_t poses_seed = 1;
  std::uint64_t noise_seed = 1;
};

// A board held so that all of it is in the picture, near and far, in every corner; corners from ar::Lens, not from the
// solver's own formulas.
Observations see(const Board& board, const ar::CameraModel& camera, const ViewSet& set);

}  // namespace calib::testing
