#pragma once

#include <chrono>
#include <string>

#include "ar/capture/live/live_source.h"

namespace ar {

// Counts frames that could not be handed out, and tells of them at most once a second.
class DroppedFrameLog {
 public:
  explicit DroppedFrameLog(std::string name) : name_(std::move(name)) {}

  void missed(std::int64_t frames) { counts_.missed += frames; }
  void damaged() { ++counts_.damaged; }
  const LiveCounts& counts() const { return counts_; }
  const std::string& name() const { return name_; }

  // Warns of what came since the last warning, where there is something and that is a second ago. Returns whether.
  bool tell(std::chrono::steady_clock::time_point now = std::chrono::steady_clock::now());

 private:
  std::string name_;
  LiveCounts counts_;
  LiveCounts told_;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace ar
