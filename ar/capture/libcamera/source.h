#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ar/capture/live/camera_mode.h"
#include "ar/capture/live/live_source.h"

namespace ar {

// A camera by libcamera's id, or its first one where `id` is empty. Frames carry exposure time, gain, colour
// temperature and lux where the camera tells them. Throws InputError.
std::unique_ptr<LiveSource> open_libcamera_source(const std::string& id, const LiveRequest& request);

// Every camera that libcamera knows. It tells sizes, but no rates.
std::vector<CameraListing> list_libcamera_cameras();

}  // namespace ar
