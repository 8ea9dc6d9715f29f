#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ar/output/sink.h"

namespace ar {

// A V4L2 output device, from which other programs take our pictures as from a webcam (v4l2loopback).
//
// `address` is its node ("/dev/video10"); empty, the first one there is. `format` is "YUYV" or "NV12"; nothing: the
// first of them that it takes. Pictures are scaled where the device has a size of its own. A frame that comes while all
// of the device's buffers are still waiting is left out: write() never waits. Throws InputError: no such device (with
// the line that makes one), busy, no permission, no size or format that fits; write() throws it when the device is
// gone.
std::unique_ptr<FrameSink> open_v4l2_sink(const std::string& address, const SourceInfo& source,
                                          const std::optional<std::string>& format = std::nullopt);

}  // namespace ar
