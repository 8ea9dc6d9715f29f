#pragma once

#include <libcamera/libcamera.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>

namespace ar::lc {

// What a camera completes on libcamera's own thread, for another one to take.
class CompletedRequests {
 public:
  void listen_to(libcamera::Camera& camera);
  void ignore(libcamera::Camera& camera);

  // The oldest that was completed; null where there is none until then, or the camera went away.
  libcamera::Request* wait_until(std::chrono::steady_clock::time_point end);
  // The camera is gone: nothing more will come.
  bool over() const;
  void give_up();

 private:
  void completed(libcamera::Request* request);

  mutable std::mutex mutex_;
  std::condition_variable change_;
  std::deque<libcamera::Request*> done_;
  bool gone_ = false;
};

}  // namespace ar::lc
