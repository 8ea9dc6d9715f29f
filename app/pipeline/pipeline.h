#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ar/capture/source.h"
#include "ar/output/sink.h"
#include "ar/track/tracker.h"

namespace app {

struct TrackedFrame {
  ar::Frame frame;
  ar::Track track;
};

// Ready to be written: a new picture at the source frame's time, or the source's own where nothing virtual is in it.
struct FinishedFrame {
  ar::Frame source;
  std::optional<ar::OutputFrame> rendered;
};

// What each stage does with a frame. Each is called from one thread only, in order of presentation.
struct Stages {
  std::function<std::optional<ar::Frame>()> decode;  // nothing: the end
  std::function<TrackedFrame(ar::Frame)> track;
  std::function<FinishedFrame(TrackedFrame)> render;  // on the calling thread, which has the GL context
  std::function<void(FinishedFrame)> encode;
};

// Time that a stage spent at work, without waiting for its neighbours.
struct StageTime {
  std::string name;
  std::vector<float> frame_ms;  // of each frame

  double busy_s() const;
  double median_ms() const;  // 0 where no frame passed
};

// Runs decode, track and encode on threads of their own and render on the caller's, with at most `depth` frames waiting
// between two of them, until decode says the end and everything is encoded. The first exception of any stage stops all
// of them and is rethrown here, once.
std::vector<StageTime> run_pipeline(const Stages& stages, std::size_t depth = 3);

}  // namespace app
