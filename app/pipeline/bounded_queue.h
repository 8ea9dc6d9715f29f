#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace app {

// Hands values from one stage's thread to the next; the producer waits while it is full, so that memory stays bounded.
template <typename T>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {}

  // Waits for room. False when the queue was aborted: the value is dropped and the producer should stop.
  bool push(T value) {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [this] { return items_.size() < capacity_ || aborted_; });
    if (aborted_) return false;
    items_.push_back(std::move(value));
    filled_.notify_one();
    return true;
  }

  // False at once when it is full, or was aborted: the value is dropped.
  bool try_push(T value) {
    const std::lock_guard lock(mutex_);
    if (items_.size() >= capacity_ || aborted_) return false;
    items_.push_back(std::move(value));
    filled_.notify_one();
    return true;
  }

  // Waits for a value. Nothing when the queue is closed and empty, or aborted.
  std::optional<T> pop() {
    std::unique_lock lock(mutex_);
    filled_.wait(lock, [this] { return !items_.empty() || closed_ || aborted_; });
    if (aborted_ || items_.empty()) return std::nullopt;
    T value = std::move(items_.front());
    items_.pop_front();
    room_.notify_one();
    return value;
  }

  // No more values will come; those inside are still handed out.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    filled_.notify_all();
  }

  // Lets go of everybody who waits; values inside are lost.
  void abort() {
    const std::lock_guard lock(mutex_);
    aborted_ = true;
    filled_.notify_all();
    room_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable room_;
  std::condition_variable filled_;
  std::deque<T> items_;
  const std::size_t capacity_;
  bool closed_ = false;
  bool aborted_ = false;
};

}  // namespace app
