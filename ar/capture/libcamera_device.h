#pragma once

#include <libcamera/libcamera.h>

#include <memory>
#include <string>
#include <vector>

#include "ar/capture/camera_mode.h"
#include "ar/capture/ffmpeg.h"

// What libcamera's words are in ours. Built for 0.0.3 and newer.
namespace ar::lc {

// The process's one camera manager, started; it goes with its last user, so that the next one sees what was plugged in
// since. Throws InputError.
std::shared_ptr<libcamera::CameraManager> camera_manager();

// libcamera names formats as DRM does; "YUYV", "RGB3" as V4L2 does. Empty for what cannot be decoded here.
std::string v4l2_name(const libcamera::PixelFormat& format);

// The modes of a generated configuration's stream. Formats that cannot be decoded are left out.
std::vector<CameraMode> modes_of(const libcamera::StreamConfiguration& stream);

void tag_colors(const libcamera::ColorSpace& color, AVFrame& picture);

// Exposure as a completed request tells it.
ExposureInfo exposure_of(const libcamera::ControlList& metadata);

}  // namespace ar::lc
