#pragma once

#include <memory>
#include <string>

#include "ar/capture/live/live_source.h"

namespace ar {

// Opens "v4l2:/dev/video0", "v4l2:" (the first camera), "libcamera:ID", "libcamera:" or "file:CLIP" (played once at
// its own rate) and starts it. Throws InputError: no such device, busy, no permission, nothing it offers fits; each
// says what to do.
std::unique_ptr<LiveSource> open_live_source(const std::string& specification, const LiveRequest& request);

}  // namespace ar
