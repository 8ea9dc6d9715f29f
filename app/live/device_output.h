#pragma once

#include <memory>
#include <string>

#include "app/live/live_frame.h"
#include "ar/capture/source.h"

namespace app {

// Hands what is shown to a V4L2 output device, from which other programs take it as from a webcam. A device that goes
// away is warned of once and then left alone: what is shown goes on.
class DeviceOutput : public LiveOutput {
 public:
  // "v4l2:/dev/video10", "v4l2:" for the first there is, with ":YUYV" or ":NV12" behind it for that format. Throws
  // ar::InputError as ar::open_v4l2_sink() does, and for other kinds.
  DeviceOutput(const std::string& specification, const ar::SourceInfo& source);

  void show(const ShownPicture& shown) override;

 private:
  std::unique_ptr<ar::FrameSink> sink_;  // null once it is gone
  std::int64_t count_ = 0;
};

}  // namespace app
