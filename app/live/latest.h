#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

namespace app {

// A place for one value between two threads: a new value takes the place of one that nobody has taken yet, so that the
// taker always gets the newest.
template <typename T>
class Latest {
 public:
  // True when a value that was never taken had to go.
  bool put(T value) {
    const std::lock_guard lock(mutex_);
    const bool stale = value_.has_value();
    value_ = std::move(value);
    changed_.notify_one();
    return stale;
  }

  // Waits at most `patience` for a value. Nothing then, or at once when it is closed and empty.
  std::optional<T> take(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, patience, [this] { return value_.has_value() || closed_; });
    return std::exchange(value_, std::nullopt);
  }

  // No more values will come; one inside is still handed out.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

  // Closed, and nothing left to take.
  bool over() const {
    const std::lock_guard lock(mutex_);
    return closed_ && !value_.has_value();
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<T> value_;
  bool closed_ = false;
};

}  // namespace app
