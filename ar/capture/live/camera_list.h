#pragma once

#include <string>
#include <vector>

#include "ar/capture/live/camera_mode.h"

namespace ar {

// A camera that is plugged in.
struct CameraListing {
  std::string source;             // what open_live_source() takes: "v4l2:/dev/video0", "libcamera:..."
  std::string name;               // "Integrated Camera"
  std::vector<CameraMode> modes;  // all that it offers, formats that cannot be decoded too
  std::string problem;            // why it cannot be used, and what to do; empty where it can
};

// The V4L2 cameras in the order of their nodes, then those that libcamera knows (a USB camera is listed by both).
// Does not start any.
std::vector<CameraListing> list_cameras();

}  // namespace ar
