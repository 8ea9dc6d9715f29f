#include "ar/capture/live/frame_clock.h"

#include <algorithm>

namespace ar {
namespace {

// No picture waits this long between the driver and its reader, who may take his time to begin: such a stamp is of
// another clock, or one that wrapped.
constexpr std::int64_t kBelievable_us = 600'000'000;
// Drivers round, and some stamp the end of a transfer a little late.
constexpr std::int64_t kAhead_us = 100'000;
// A jump back, or by half of the range, is a stream that began anew, not a gap.
constexpr std::uint32_t kAnew = 1U << 31U;

bool believable(std::int64_t taken_us, std::int64_t now_us) {
  return taken_us <= now_us + kAhead_us && now_us - taken_us < kBelievable_us;
}

}  // namespace

FrameClock::Reading FrameClock::read(const DriverStamp& stamp, std::int64_t now_us) {
  Reading reading;
  if (sequence_) {
    const std::uint32_t step = stamp.sequence - *sequence_;  // right through the wrap
    if (step != 0 && step < kAnew) reading.missed = step - 1;
  }
  sequence_ = stamp.sequence;

  std::int64_t taken_us = stamp.taken_us.value_or(now_us);
  if (!believable(taken_us, now_us)) {
    reading.foreign = true;
    if (!believable(taken_us + offset_us_, now_us)) offset_us_ = now_us - taken_us;
    taken_us += offset_us_;
  }
  reading.taken_us = std::max(std::min(taken_us, now_us), last_us_ + 1);
  last_us_ = reading.taken_us;
  return reading;
}

}  // namespace ar
