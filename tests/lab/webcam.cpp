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

namespace ar::testing {
namespace {

using std::chrono::steady_clock;

// Requests of the USB Video Class, A.8.
constexpr unsigned kSetCurrent = 0x01;
constexpr unsigned kGetCurrent = 0x81;
constexpr unsigned kGetMinimum = 0x82;
constexpr unsigned kGetMaximum = 0x83;
constexpr unsigned kGetResolution = 0x84;
constexpr unsigned kGetLength = 0x85;
constexpr unsigned kGetInfo = 0x86;
constexpr unsigned kGetDefault = 0x87;

constexpr std::size_t kProbeBytes = 34;  // version 1.1's

std::uint32_t get(const std::uint8_t* bytes, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = count; i-- > 0;) value = value << 8U | bytes[i];
  return value;
}

void set(std::uint8_t* bytes, std::size_t count, std::uint32_t value) {
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>(value >> 8U * i);
}

// A control of the camera, A.9.4 and A.9.5.
struct Control {
  unsigned entity;
  unsigned selector;
  std::size_t bytes;
  std::uint32_t minimum;
  std::uint32_t maximum;
  std::uint32_t resolution;  // of the exposure mode: the set of modes it knows
  std::uint32_t initial;
  std::uint32_t current;
};

std::vector<Control> all_controls() {
  return {
      {kCameraTerminal, 0x02, 1, 0, 0, 0x09, 0x08, 0x08},     // exposure mode: manual 1, aperture priority 8
      {kCameraTerminal, 0x04, 4, 1, 5000, 1, 156, 156},       // exposure time, 100 us
      {kCameraTerminal, 0x06, 2, 0, 250, 5, 0, 0},            // focus
      {kCameraTerminal, 0x08, 1, 0, 1, 1, 1, 1},              // focus by itself
      {kProcessingUnit, 0x02, 2, 0, 255, 1, 128, 128},        // brightness
      {kProcessingUnit, 0x04, 2, 0, 100, 1, 10, 10},          // gain
      {kProcessingUnit, 0x0a, 2, 2000, 6500, 1, 4000, 4000},  // white balance, K
      {kProcessingUnit, 0x0b, 1, 0, 1, 1, 1, 1},              // white balance by itself
  };
}

struct Setup {
  unsigned type;
  unsigned request;
  unsigned value;
  unsigned index;
  unsigned length;
};

Setup parse(const std::array<std::uint8_t, 8>& bytes) {
  return {bytes[0], bytes[1], get(&bytes[2], 2), get(&bytes[4], 2), get(&bytes[6], 2)};
}

}  // namespace

class Webcam::Device {
 public:
  explicit Device(WebcamModel model) : model_(std::move(model)), wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    settle(probe_);
    commit_ = probe_;
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
  bool standard(const Setup& setup, Bytes& reply);
  bool video_class(const Setup& setup, const Bytes& data, Bytes& reply);
  bool negotiate(Bytes& state, const Setup& setup, const Bytes& data, Bytes& reply);
  static bool use(Control& control, const Setup& setup, const Bytes& data, Bytes& reply);
  void settle(Bytes& state) const;
  void unlink(const usbip::Request& request);
  void pump();
  void next_payload();

  WebcamModel model_;
  int wake_;
  int number_ = -1;
  std::optional<usbip::Port> port_;
  std::thread worker_;
  std::atomic<bool> stop_{false};
  std::vector<Control> controls_ = all_controls();
  Bytes probe_ = Bytes(kProbeBytes);
  Bytes commit_ = Bytes(kProbeBytes);
  std::deque<usbip::Request> waiting_;  // for pictures
  Bytes payload_;                       // the picture that is on its way, empty between pictures
  std::size_t given_ = 0;               // bytes of it
  std::size_t shown_ = 0;
  std::uint8_t toggle_ = 0;
  steady_clock::time_point due_{};
};

// Makes what the host proposes into something this camera can do; 4.3.1.1.
void Webcam::Device::settle(Bytes& state) const {
  if (find_stream(model_, state[2], 1) == nullptr) state[2] = 1;
  if (find_stream(model_, state[2], state[3]) == nullptr) state[3] = 1;
  const std::uint32_t fast = model_.interval_100ns(false);
  const std::uint32_t slow = model_.interval_100ns(true);
  set(&state[4], 4, get(&state[4], 4) > (fast + slow) / 2 ? slow : fast);
  const std::uint32_t largest = find_stream(model_, state[2], state[3])->largest_bytes();
  set(&state[18], 4, largest);
  set(&state[22], 4, largest + 1024);  // a picture is one payload, which a short transfer ends
  set(&state[26], 4, 48'000'000);
  set(&state[30], 4, 0x01010103);
}

bool Webcam::Device::negotiate(Bytes& state, const Setup& setup, const Bytes& data, Bytes& reply) {
  if (setup.request == kSetCurrent) {
    std::copy_n(data.begin(), std::min(data.size(), state.size()), state.begin());
    settle(state);
    if (&state == &commit_) {
      payload_.clear();
      due_ = steady_clock::now();
    }
    return true;
  }
  reply = state;
  if (setup.request == kGetLength) reply = {static_cast<std::uint8_t>(kProbeBytes), 0};
  if (setup.request == kGetInfo) reply = {3};
  return true;
}

bool Webcam::Device::use(Control& control, const Setup& setup, const Bytes& data, Bytes& reply) {
  std::uint32_t value = 0;
  switch (setup.request) {
    case kSetCurrent:
      if (data.size() < control.bytes) return false;
      control.current = get(data.data(), control.bytes);
      return true;
    case kGetCurrent:
      value = control.current;
      break;
    case kGetMinimum:
      value = control.minimum;
      break;
    case kGetMaximum:
      value = control.maximum;
      break;
    case kGetResolution:
      value = control.resolution;
      break;
    case kGetDefault:
      value = control.initial;
      break;
    case kGetLength:
      reply = {static_cast<std::uint8_t>(control.bytes), 0};
      return true;
    case kGetInfo:
      reply = {3};
      return true;
    default:
      return false;
  }
  reply.resize(control.bytes);
  set(reply.data(), control.bytes, value);
  return true;
}

bool Webcam::Device::video_class(const Setup& setup, const Bytes& data, Bytes& reply) {
  const unsigned selector = setup.value >> 8U;
  const unsigned entity = setup.index >> 8U;
  if ((setup.index & 0xffU) == 1) {
    if (selector == 1) return negotiate(probe_, setup, data, reply);
    if (selector == 2) return negotiate(commit_, setup, data, reply);
    return false;
  }
  for (Control& control : controls_) {
    if (control.entity == entity && control.selector == selector) return use(control, setup, data, reply);
  }
  if (entity != 0 || selector != 2) return false;
  reply = {6};  // what failed last: no such control
  return true;
}

bool Webcam::Device::standard(const Setup& setup, Bytes& reply) {
  enum : unsigned { kGetStatus = 0, kClearFeature = 1, kSetFeature = 3, kSetAddress = 5, kGetDescriptor = 6 };
  enum : unsigned { kGetConfiguration = 8, kSetConfiguration = 9, kGetInterface = 10, kSetInterface = 11 };
  switch (setup.request) {
    case kGetStatus:
      reply = {0, 0};
      return true;
    case kClearFeature:
      payload_.clear();  // of the endpoint's halt: a stream begins anew
      return true;
    case kSetFeature:
    case kSetAddress:
    case kSetConfiguration:
    case kSetInterface:
      return true;
    case kGetConfiguration:
      reply = {1};
      return true;
    case kGetInterface:
      reply = {0};
      return true;
    case kGetDescriptor:
      break;
    default:
      return false;
  }
  switch (setup.value >> 8U) {
    case 1:
      reply = device_descriptor();
      break;
    case 2:
      reply = configuration_descriptor(model_);
      break;
    case 3:
      reply = string_descriptor(model_, setup.value & 0xffU);
      break;
    case 6:
      reply = device_qualifier();
      break;
    default:
      break;
  }
  return !reply.empty();
}

void Webcam::Device::handle(const usbip::Request& request) {
  if (request.unlink) return unlink(request);
  if (request.endpoint != 0) {
    waiting_.push_back(request);
    return;
  }
  const Setup setup = parse(request.setup);
  Bytes reply;
  const bool of_class = (setup.type & 0x60U) == 0x20;
  const bool known = of_class ? video_class(setup, request.data, reply) : standard(setup, reply);
  if (reply.size() > setup.length) reply.resize(setup.length);
  port_->answer(request, known ? 0 : usbip::kStalled, reply, request.length);
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
  const auto interval = std::chrono::nanoseconds(std::int64_t{100} * get(&commit_[4], 4));
  // A late picture may be followed sooner by the next, but a hang is not made up for.
  due_ = std::max(due_ + interval, steady_clock::now() - std::chrono::milliseconds(10));
  const WebcamStream& stream = *find_stream(model_, commit_[2], commit_[3]);
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
