#pragma once

#include <opencv2/core.hpp>

#include "ar/capture/frame.h"

namespace ar {

// A frame's luma as an 8-bit grey picture: 8 bits are used as they lie, then the picture borrows the frame's memory and
// must not outlive it; more are shifted, and RGB is converted, into `room`.
cv::Mat grey8(const Frame& frame, cv::Mat& room);

}  // namespace ar
