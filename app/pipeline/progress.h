#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace app {

// Progress on standard error: a bar on a terminal, a line every few seconds otherwise, nothing when quiet.
class Progress {
 public:
  // `total` frames, where known; it may be wrong.
  Progress(std::optional<std::int64_t> total, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // `done` frames are through.
  void update(std::int64_t done);

 private:
  using Clock = std::chrono::steady_clock;
  void draw(std::int64_t done, double rate) const;

  const std::optional<std::int64_t> total_;
  const bool terminal_;
  const bool quiet_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace app
