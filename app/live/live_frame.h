#pragma once

#include <vector>

#include "app/live/feed.h"
#include "app/pipeline/pipeline.h"
#include "ar/output/sink.h"
#include "ar/track/detector.h"

namespace app {

// A frame with its own pose, ready to be drawn.
struct TrackedLiveFrame {
  TrackedFrame tracked;
  LiveClock::time_point arrived;
  double track_ms = 0.0;
  std::vector<ar::Detection> detections;  // known tags or not
};

// A picture as it is shown, recorded and handed on. The pixels are shared and no longer change.
struct ShownPicture {
  ar::OutputFrame picture;
  double time_s = 0.0;  // when it was taken, CLOCK_MONOTONIC
  bool held = false;    // the last one before the camera was lost
};

// Where shown pictures go. Called from one thread.
class LiveOutput {
 public:
  virtual ~LiveOutput() = default;
  virtual void show(const ShownPicture& shown) = 0;
  virtual void finish() {}
};

inline double milliseconds_between(LiveClock::time_point from, LiveClock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

// Age of a picture that was taken at that time.
inline double age_ms(double time_s, LiveClock::time_point now) {
  return (std::chrono::duration<double>(now.time_since_epoch()).count() - time_s) * 1e3;
}

}  // namespace app
