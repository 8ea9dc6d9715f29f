#pragma once

#include <linux/videodev2.h>

#include <vector>

#include "ar/capture/v4l2/device.h"

// What a capture device is asked for before it streams. Errors are InputError.
namespace ar::v4l2 {

// Size and format as the driver set them.
struct StreamFormat {
  v4l2_pix_format picture{};       // of a picture with several planes of memory, the stride is the first one's
  std::vector<int> strides_bytes;  // of each plane of memory
};

// The mode that serves the request best.
ModeChoice choose(const Device& device, const LiveRequest& request);

StreamFormat set_format(const Device& device, const CameraMode& mode);

// Asks for a rate, frames a second; the one that the driver gives, 0/1 where it does not say.
Rational set_rate(const Device& device, double rate);

}  // namespace ar::v4l2
