#pragma once

#include <string>
#include <vector>

#include "ar/capture/live/camera_mode.h"

namespace ar {

// The V4L2 cameras in the order of their nodes, then those that libcamera knows (a USB camera is listed by both).
// Does not start any.
std::vector<CameraListing> list_cameras();

}  // namespace ar
