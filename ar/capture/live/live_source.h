#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ar/capture/frame.h"
#include "ar/capture/live/camera_controls.h"
#include "ar/capture/source.h"

namespace ar {

// What is wanted of a camera; what is left open is chosen by what it can do.
struct LiveRequest {
  std::optional<int> width;
  std::optional<int> height;
  std::optional<double> rate;                 // frames a second
  std::optional<std::string> format;          // FourCC as the driver writes it: "YUYV", "NV12", "MJPG"
  std::vector<ControlSetting> controls = {};  // set when it is opened, and again after it was lost
};

enum class LiveStatus {
  Frame,  // `frame` is set
  Quiet,  // nothing came in time; the device is there
  Lost,   // the device is gone: let go of the source and open it again
  End,    // a file played as if live is over
};

struct LiveRead {
  LiveStatus status = LiveStatus::Quiet;
  // time_s is when the driver says the picture was taken, seconds of CLOCK_MONOTONIC (std::chrono::steady_clock), so
  // that steady_clock::now() less time_s is its age.
  std::optional<Frame> frame;
  std::string reason;  // of Lost: one line
};

// Frames that could not be handed out, so far.
struct LiveCounts {
  std::int64_t missed = 0;   // the driver's sequence numbers jumped: it had no free buffer, or lost them
  std::int64_t damaged = 0;  // marked broken by the driver, too short, or not decodable; skipped
};

// Frames as they come from a camera, newest last. A frame on loan holds one of a few buffers: let go of it soon.
class LiveSource {
 public:
  virtual ~LiveSource() = default;
  virtual const SourceInfo& info() const = 0;
  // What finds the same device again after it was unplugged: a specification for open_live_source() that does not
  // depend on the order of plugging in.
  virtual std::string identity() const = 0;
  // Waits for the next frame, at most `patience`. Skips damaged ones. Used by one thread.
  virtual LiveRead read(std::chrono::milliseconds patience) = 0;
  virtual LiveCounts counts() const = 0;
  // Exposure, gain, focus and white balance, as long as the source lives; null where there are none. May be used by
  // another thread than the one that reads.
  virtual CameraControls* controls() { return nullptr; }
};

}  // namespace ar
