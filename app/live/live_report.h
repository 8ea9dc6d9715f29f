#pragma once

#include <filesystem>
#include <string>

#include "app/live/distribution.h"
#include "app/live/draw_stage.h"
#include "app/live/feed.h"
#include "app/process/report.h"
#include "ar/capture/source.h"

namespace app {

// Times of the frames that were shown, ms.
struct LiveTimes {
  Distribution latency;   // from the instant the picture was taken to its presentation
  Distribution pipeline;  // of that, from the instant the program got it
  Distribution track;
  Distribution draw;
  Distribution present;
  Distribution interval;  // from one presentation to the next
};

// What a live run leaves behind for whoever measures it.
struct LiveFacts {
  FeedCounts feed;
  FrameCounts tracked;
  std::int64_t presented = 0;
  std::int64_t stale_tracked = 0;
  std::int64_t held = 0;  // times that a held picture was shown
  std::int64_t recorded = 0;
  std::int64_t left_out = 0;  // of the recording
  LiveTimes times;
  double wall_s = 0.0;  // from the first presentation to the last
  bool interrupted = false;

  // Of all that the camera took, the part that was never shown.
  std::int64_t dropped() const { return feed.stale + feed.missed + feed.damaged + stale_tracked; }
  double per_second() const;
};

// Writes the facts as JSON, whole or not at all. Throws std::runtime_error when it cannot.
void write_live_report(const std::filesystem::path& path, const ar::SourceInfo& source, const LiveFacts& facts,
                       const DrawStage& drawing);

}  // namespace app
