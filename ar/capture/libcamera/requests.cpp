#include "ar/capture/libcamera/requests.h"

namespace ar::lc {

void CompletedRequests::listen_to(libcamera::Camera& camera) {
  camera.requestCompleted.connect(this, &CompletedRequests::completed);
  camera.disconnected.connect(this, &CompletedRequests::give_up);
}

void CompletedRequests::ignore(libcamera::Camera& camera) {
  camera.requestCompleted.disconnect(this);
  camera.disconnected.disconnect(this);
}

void CompletedRequests::completed(libcamera::Request* request) {
  if (request->status() == libcamera::Request::RequestCancelled) return;
  const std::lock_guard lock(mutex_);
  done_.push_back(request);
  change_.notify_one();
}

void CompletedRequests::give_up() {
  const std::lock_guard lock(mutex_);
  gone_ = true;
  change_.notify_one();
}

libcamera::Request* CompletedRequests::wait_until(std::chrono::steady_clock::time_point end) {
  std::unique_lock lock(mutex_);
  change_.wait_until(lock, end, [this] { return gone_ || !done_.empty(); });
  if (done_.empty()) return nullptr;
  libcamera::Request* request = done_.front();
  done_.pop_front();
  return request;
}

bool CompletedRequests::over() const {
  const std::lock_guard lock(mutex_);
  return gone_;
}

}  // namespace ar::lc
