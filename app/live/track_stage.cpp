#include "app/live/track_stage.h"

#include "app/process/tracked_scene.h"

namespace app {

TrackStage::TrackStage(LiveFeed& feed, const ar::CameraModel& camera, const ar::TagMap& tags,
                       std::unique_ptr<PosesCsv> poses)
    : feed_(feed), tracker_(make_tracker(camera, tags)), poses_(std::move(poses)) {}

TrackStage::~TrackStage() {
  thread_ = {};
}

void TrackStage::start() {
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void TrackStage::finish() {
  thread_ = {};
  if (poses_) poses_->finish();
}

void TrackStage::run(const std::stop_token& stop) {
  try {
    while (!stop.stop_requested()) {
      if (auto arrived = feed_.take(std::chrono::milliseconds(50))) {
        track(std::move(*arrived));
      } else if (feed_.over()) {
        break;
      }
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
  }
  frames_.close();
}

void TrackStage::track(ArrivedFrame arrived) {
  const auto start = LiveClock::now();
  ar::Frame& frame = arrived.frame;
  ar::Track track = tracker_.track(frame);
  if (!start_s_) start_s_ = frame.time_s;
  if (poses_) poses_->add(frame.index, frame.time_s - *start_s_, track);
  {
    const std::lock_guard lock(mutex_);
    counts_.add(track.state);
  }
  if (frames_.put({.tracked = {std::move(frame), std::move(track)},
                   .arrived = arrived.arrived,
                   .track_ms = milliseconds_between(start, LiveClock::now()),
                   .detections = tracker_.detections()})) {
    ++stale_;
  }
}

bool TrackStage::over() const {
  if (!frames_.over()) return false;
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
  return true;
}

FrameCounts TrackStage::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

}  // namespace app
