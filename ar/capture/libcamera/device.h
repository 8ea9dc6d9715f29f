#pragma once

#include <libcamera/libcamera.h>

#include <memory>
#include <string>
#include <vector>

#include "ar/capture/ffmpeg.h"
#include "ar/capture/live/camera_mode.h"

// What libcamera's words are in ours. Built for 0.0.3 and newer.
namespace ar::lc {

// The process's one camera manager, started; it goes with its last user, so that the next one sees what was plugged in
// since. Throws InputError.
std::shared_ptr<libcamera::CameraManager> camera_manager();

// The camera of that id; the first for an empty one. Throws InputError.
std::shared_ptr<libcamera::Camera> find_camera(libcamera::CameraManager& manager, const std::string& id);

// Throws the InputError of a call that returned `error` (-EBUSY).
[[noreturn]] void refuse(const libcamera::Camera& camera, const std::string& what, int error);

// For people: the sensor's model.
std::string name_of(const libcamera::Camera& camera);

// libcamera names formats as DRM does; "YUYV", "RGB3" as V4L2 does. Empty for what cannot be decoded here.
std::string v4l2_name(const libcamera::PixelFormat& format);

// The modes of a generated configuration's stream. Formats that cannot be decoded are left out.
std::vector<CameraMode> modes_of(const libcamera::StreamConfiguration& stream);

// Configures an acquired camera for the stream that serves the request best. Throws InputError.
std::unique_ptr<libcamera::CameraConfiguration> configure(libcamera::Camera& camera, const LiveRequest& request);

void tag_colors(const libcamera::ColorSpace& color, AVFrame& picture);

// Exposure as a completed request tells it.
ExposureInfo exposure_of(const libcamera::ControlList& metadata);

}  // namespace ar::lc
