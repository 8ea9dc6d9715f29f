#pragma once

#include <cstdint>
#include <optional>

namespace ar {

// What a driver says of one frame.
struct DriverStamp {
  std::uint32_t sequence = 0;            // counts on, through 0 after 2^32 - 1
  std::optional<std::int64_t> taken_us;  // CLOCK_MONOTONIC; nothing: it does not say
};

// Makes a driver's numbers into times that rise and are in CLOCK_MONOTONIC, and finds the gaps.
class FrameClock {
 public:
  struct Reading {
    std::int64_t taken_us = 0;  // rises strictly from frame to frame, never after `now_us`
    std::uint32_t missed = 0;   // frames between the last one and this
    bool foreign = false;       // the driver's time is of another clock: it was carried over by its offset
  };

  // `now_us`: when the frame was received, CLOCK_MONOTONIC.
  Reading read(const DriverStamp& stamp, std::int64_t now_us);

 private:
  std::optional<std::uint32_t> sequence_;
  std::int64_t last_us_ = 0;
  std::int64_t offset_us_ = 0;
};

}  // namespace ar
