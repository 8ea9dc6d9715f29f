#pragma once

#include <optional>
#include <vector>

#include "ar/track/camera.h"
#include "ar/track/lens.h"
#include "ar/track/pose.h"
#include "calib/boards/board.h"
#include "calib/boards/observation.h"
#include "calib/solve/lens_choice.h"

namespace calib {

// Where a solver can begin: a camera without distortion (a fisheye with none in its angle).
struct Start {
  ar::CameraModel camera;
  double rms_px = 0.0;
};

// Poses that explain a view through a known camera: both of a flat board (Collins and Bartoli 2014), best first.
std::vector<ar::Rigid3> poses_of(const Board& board, const Observation& view, const ar::Lens& lens);

// Root of the mean squared distance of a view's points at that pose; infinite when one cannot be projected.
double view_rms_px(const Board& board, const Observation& view, const ar::Lens& lens,
                   const ar::Rigid3& camera_from_board);

// The one of them that explains the view best.
std::optional<ar::Rigid3> best_pose_of(const Board& board, const Observation& view, const ar::Lens& lens);

// Tries focal lengths from that of a fisheye to that of a telephoto and keeps the one that explains the views best.
// nullopt when no view has 4 points that any camera explains.
std::optional<Start> find_start(const Board& board, const Observations& observations, LensChoice lens);

}  // namespace calib
