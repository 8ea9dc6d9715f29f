#pragma once

#include <string>

#include "ar/capture/live/live_source.h"

namespace ar {

// A V4L2 camera. `address` is a node ("/dev/video0", or a link to one), empty for the first camera, or "bus=INFO".
// Throws InputError.
std::unique_ptr<LiveSource> open_v4l2_source(const std::string& address, const LiveRequest& request);

}  // namespace ar
