#pragma once

#include <optional>
#include <string>

#include "app/calibration/gather.h"
#include "app/live/feed.h"
#include "ar/capture/live/live_source.h"
#include "calib/boards/board.h"

namespace app {

struct LiveGatherOptions {
  std::string source;  // as ar::open_live_source() reads it
  ar::LiveRequest request;
  FeedOptions feed;
  bool headless = false;  // what happens is reported on standard error instead of in a window
  int most_views = 40;
};

// Takes views of the board out of a camera's pictures as calib::ViewCollector does, and tells which to hold next. Ends
// when there are enough, by a key, when the window is closed, at the file's end or by an interrupt: what was taken
// until then counts. Throws ar::InputError: no such camera, no view taken.
Gathered gather_live(const calib::Board& board, const LiveGatherOptions& options);

}  // namespace app
