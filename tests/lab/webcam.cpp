#include "tests/lab/webcam.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <deque>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

#include "tests/lab/usbip.h"
#include "tests/lab/uvc_function.h"

namespace ar::testing {
namespace {

using std::chrono::steady_clock;

}  // namespace

class Webcam::Device {
 public:
  explicit Device(WebcamModel model) : function_(std::move(model)), wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    plug_in();
  }
  ~Device() {
    pull_out();
    close(wake_);
  }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  void plug_in() {
    if (port_) return;
    port_.emplace(number_);
    number_ = port_->number();
    stop_ = false;
    worker_ = std::thread([this] { run(); });
  }

  void pull_out() {
    if (!port_) return;
    stop_ = true;
    wake();
    worker_.join();
    port_.reset();
    waiting_.clear();
    payload_.clear();
  }

  void wake() const {
    const std::uint64_t one = 1;
    if (write(wake_, &one, sizeof one) != sizeof one) std::perror("eventfd");
  }

  std::atomic<bool> hangs_{false};
  std::atomic<bool> damage_{false};
  std::atomic<bool> cut_{false};
  std::atomic<bool> hold_{false};

 private:
  void run();
  int patience_ms() const;
  void handle(const usbip::Request& request);
  void unlink(const usbip::Request& request);
  void pump();
  void next_payload();

  UvcFunction function_;
  int wake_;
  int number_ = -1;
  std::optional<usbip::Port> port_;
  std::thread worker_;
  std::atomic<bool> stop_{false};
  std::deque<usbip::Request> waiting_;  // for pictures
  Bytes payload_;                       // the picture that is on its way, empty between pictures
  std::size_t given_ = 0;               // bytes of it
  std::size_t shown_ = 0;
  std::uint8_t toggle_ = 0;
  steady_clock::time_point due_{};
};

void Webcam::Device::handle(const usbip::Request& request) {
  if (request.unlink) return unlink(request);
  if (request.endpoint != 0) {
    waiting_.push_back(request);
    return;
  }
  const std::optional<Bytes> reply = function_.answer(request.setup, request.data);
  port_->answer(request, reply ? 0 : usbip::kStalled, reply.value_or(Bytes{}), request.length);
  if (function_.begun_anew()) payload_.clear();
  if (function_.chosen()) due_ = steady_clock::now();
}

void Webcam::Device::unlink(const usbip::Request& request) {
  const auto waits = [&](const usbip::Request& other) { return other.number == request.unlinked; };
  const auto found = std::find_if(waiting_.begin(), waiting_.end(), waits);
  const bool dropped = found != waiting_.end();
  if (dropped) waiting_.erase(found);
  port_->answer_unlink(request, dropped);
}

// The header of 2.4.3.3, then the picture.
void Webcam::Device::next_payload() {
  // A late picture may be followed sooner by the next, but after a hang time is counted anew: two pictures that are
  // taken a moment apart and show a whole interval's motion would mislead whoever tracks it.
  const auto now = steady_clock::now();
  if (now - due_ > std::chrono::milliseconds(10)) due_ = now;
  due_ += function_.interval();
  const WebcamStream& stream = function_.stream();
  const Bytes& picture = stream.pictures[shown_++ % stream.pictures.size()];
  const bool damaged = damage_.exchange(false);
  const bool cut = cut_.exchange(false) || damaged;
  constexpr unsigned kEndOfHeader = 0x80;
  constexpr unsigned kEndOfFrame = 0x02;
  payload_ = {2, static_cast<std::uint8_t>(kEndOfHeader | kEndOfFrame | (damaged ? 0x40U : 0U) | toggle_)};
  payload_.insert(payload_.end(), picture.begin(), picture.end() - (cut ? std::ssize(picture) / 2 : 0));
  toggle_ ^= 1U;
  given_ = 0;
}

// Answers waiting transfers with as much of the pictures as is due.
void Webcam::Device::pump() {
  while (!waiting_.empty()) {
    if (payload_.empty()) {
      if (steady_clock::now() < due_) return;
      next_payload();
    }
    const usbip::Request request = std::move(waiting_.front());
    waiting_.pop_front();
    const std::size_t size = std::min<std::size_t>(request.length, payload_.size() - given_);
    port_->answer(request, 0, std::span(payload_).subspan(given_, size));
    given_ += size;
    if (size < request.length) payload_.clear();
  }
}

int Webcam::Device::patience_ms() const {
  if (hangs_ || hold_ || waiting_.empty() || !payload_.empty()) return -1;
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(due_ - steady_clock::now());
  return static_cast<int>(std::max<std::int64_t>(0, left.count()));
}

void Webcam::Device::run() try {
  while (!stop_) {
    // poll() passes over negative descriptors.
    pollfd sources[] = {{hangs_ ? -1 : port_->descriptor(), POLLIN, 0}, {wake_, POLLIN, 0}};
    poll(sources, 2, patience_ms());
    std::uint64_t woken = 0;
    if (sources[1].revents != 0 && read(wake_, &woken, sizeof woken) < 0) return;
    if (sources[0].revents != 0) handle(port_->receive());
    if (!hangs_ && !hold_) pump();
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "webcam: %s\n", error.what());
}

Webcam::Webcam(WebcamModel model) : device_(std::make_unique<Device>(std::move(model))) {}

Webcam::~Webcam() = default;

void Webcam::pull_out() {
  device_->pull_out();
}

void Webcam::plug_in() {
  device_->plug_in();
}

void Webcam::hang(bool hangs) {
  device_->hangs_ = hangs;
  device_->wake();
}

void Webcam::damage_next_picture() {
  device_->damage_ = true;
}

void Webcam::cut_next_picture() {
  device_->cut_ = true;
}

void Webcam::hold_pictures(bool hold) {
  device_->hold_ = hold;
  device_->wake();
}

}  // namespace ar::testing
