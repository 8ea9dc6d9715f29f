#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include "app/live/live_frame.h"
#include "app/process/poses_csv.h"
#include "app/process/report.h"
#include "ar/track/tracker.h"

namespace app {

// Finds the camera's pose in every frame that the feed gives, on a thread of its own, and keeps the newest for whoever
// draws.
class TrackStage {
 public:
  // `poses` may be null. Borrows `feed`, which is started.
  TrackStage(LiveFeed& feed, const ar::CameraModel& camera, const ar::TagMap& tags, std::unique_ptr<PosesCsv> poses);
  ~TrackStage();
  TrackStage(const TrackStage&) = delete;
  TrackStage& operator=(const TrackStage&) = delete;

  void start();
  // Ends the thread and finishes the poses.
  void finish();

  std::optional<TrackedLiveFrame> take(std::chrono::milliseconds patience) { return frames_.take(patience); }
  // Nothing more will come. Rethrows what went wrong in the thread or in the feed's.
  bool over() const;
  FrameCounts counts() const;
  // Frames that were tracked but dropped for a newer one.
  std::int64_t stale() const { return stale_; }

 private:
  void run(const std::stop_token& stop);
  void track(ArrivedFrame arrived);

  LiveFeed& feed_;
  ar::Tracker tracker_;  // of the thread, once it runs
  std::unique_ptr<PosesCsv> poses_;
  std::optional<double> start_s_;  // time of the first frame
  Latest<TrackedLiveFrame> frames_;
  std::atomic<std::int64_t> stale_ = 0;
  mutable std::mutex mutex_;
  FrameCounts counts_;
  std::exception_ptr failure_;
  std::jthread thread_;
};

}  // namespace app
