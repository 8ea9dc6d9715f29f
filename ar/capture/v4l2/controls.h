#pragma once

#include <atomic>
#include <memory>

#include "ar/capture/live/camera_controls.h"
#include "ar/capture/v4l2/device.h"

namespace ar::v4l2 {

// The controls of a V4L2 camera. May be used beside the thread that reads its frames.
class Controls : public CameraControls {
 public:
  explicit Controls(std::shared_ptr<const Device> device);

  std::optional<ControlState> read(CameraControl control) const override;
  bool set(CameraControl control, double value) override;
  bool set_automatic(CameraControl control, bool automatic) override;

  // The exposure time, s, where it was set or locked and so is that of every frame.
  std::optional<double> fixed_exposure_s() const;

 private:
  void note_exposure();
  bool switch_automatic(CameraControl control, bool automatic) const;

  std::shared_ptr<const Device> device_;
  std::atomic<double> fixed_exposure_s_;  // 0: not fixed
};

}  // namespace ar::v4l2
