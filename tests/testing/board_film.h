#pragma once

#include <filesystem>
#include <vector>

#include "ar/track/camera.h"
#include "calib/boards/board.h"
#include "calib/views/next_view.h"

namespace calib::testing {

// A stretch of a recording: the board goes to a place, and stays there for a while.
struct Stay {
  ar::Rigid3 camera_from_board;
  double move_s = 0.4;
  double stay_s = 0.6;
  double shake_px = 0.0;  // of an unsteady hand while it stays, amplitude, 4 Hz
};

// Pose of the board as that camera sees it held so. Throws std::runtime_error where it does not fit into the picture.
ar::Rigid3 pose_held(const Board& board, const ar::CameraModel& camera, const HeldView& view);

struct Film {
  double fps = 10.0;
  double shutter_s = 0.03;
  double noise_codes = 1.5;
};

// Films a grid of tags that is moved from stay to stay: through the camera's exact lens, with motion blur over the
// shutter's time, a slightly soft picture, noise, 8 bits.
void film_board(const std::filesystem::path& path, const Board& grid, const ar::CameraModel& camera,
                const std::vector<Stay>& stays, const Film& film);

}  // namespace calib::testing
