#include "ar/capture/live/dropped_frame_log.h"

#include <spdlog/spdlog.h>

namespace ar {

bool DroppedFrameLog::tell(std::chrono::steady_clock::time_point now) {
  const std::int64_t missed = counts_.missed - told_.missed;
  const std::int64_t damaged = counts_.damaged - told_.damaged;
  if (missed + damaged == 0 || now - last_ < std::chrono::seconds(1)) return false;
  spdlog::warn("{}: {} frames missed and {} damaged since the last word of it ({} and {} in all)", name_, missed,
               damaged, counts_.missed, counts_.damaged);
  told_ = counts_;
  last_ = now;
  return true;
}

}  // namespace ar
