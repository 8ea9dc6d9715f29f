#pragma once

#include <libcamera/libcamera.h>

#include <memory>
#include <mutex>

#include "ar/capture/live/camera_controls.h"

namespace ar::lc {

// The controls of a camera that libcamera drives: what is set goes out with the next request, and its effect comes back
// with a frame. May be used beside the thread that reads the frames.
class Controls : public CameraControls {
 public:
  explicit Controls(std::shared_ptr<libcamera::Camera> camera);

  std::optional<ControlState> read(CameraControl control) const override;
  bool set(CameraControl control, double value) override;
  bool set_automatic(CameraControl control, bool automatic) override;

  // What was set since the last call.
  libcamera::ControlList take();
  // Remembers what a frame says of itself.
  void note(const libcamera::ControlList& metadata);

 private:
  bool switch_automatic(CameraControl control, bool automatic);

  mutable std::mutex mutex_;
  std::shared_ptr<libcamera::Camera> camera_;
  libcamera::ControlList pending_;
  std::array<std::optional<double>, kCameraControls.size()> value_;
  std::array<bool, kCameraControls.size()> automatic_;
};

}  // namespace ar::lc
