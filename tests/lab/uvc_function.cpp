#include "tests/lab/uvc_function.h"

#include <algorithm>
#include <utility>

namespace ar::testing {

// A control of the camera, A.9.4 and A.9.5.
struct UvcControl {
  unsigned entity;
  unsigned selector;
  std::size_t bytes;
  std::uint32_t minimum;
  std::uint32_t maximum;
  std::uint32_t resolution;  // of the exposure mode: the set of modes it knows
  std::uint32_t initial;
  std::uint32_t current;
};

namespace {

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

std::vector<UvcControl> all_controls() {
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

bool use(UvcControl& control, unsigned asked, const Bytes& data, Bytes& reply) {
  std::uint32_t value = 0;
  switch (asked) {
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

}  // namespace

struct UvcFunction::Setup {
  unsigned type;
  unsigned request;
  unsigned value;
  unsigned index;
  unsigned length;
};

UvcFunction::UvcFunction(WebcamModel model)
    : model_(std::move(model)), controls_(all_controls()), probe_(kProbeBytes), commit_(kProbeBytes) {
  settle(probe_);
  commit_ = probe_;
}

UvcFunction::~UvcFunction() = default;

std::optional<Bytes> UvcFunction::answer(const std::array<std::uint8_t, 8>& bytes, const Bytes& data) {
  const Setup setup{bytes[0], bytes[1], get(&bytes[2], 2), get(&bytes[4], 2), get(&bytes[6], 2)};
  Bytes reply;
  const bool of_class = (setup.type & 0x60U) == 0x20;
  if (!(of_class ? video_class(setup, data, reply) : standard(setup, reply))) return std::nullopt;
  if (reply.size() > setup.length) reply.resize(setup.length);
  return reply;
}

const WebcamStream& UvcFunction::stream() const {
  return *find_stream(model_, commit_[2], commit_[3]);
}

std::chrono::nanoseconds UvcFunction::interval() const {
  return std::chrono::nanoseconds(std::int64_t{100} * get(&commit_[4], 4));
}

bool UvcFunction::begun_anew() {
  return std::exchange(begun_anew_, false);
}

bool UvcFunction::chosen() {
  return std::exchange(chosen_, false);
}

// Makes what the host proposes into something this camera can do; 4.3.1.1.
void UvcFunction::settle(Bytes& state) const {
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

bool UvcFunction::negotiate(Bytes& state, const Setup& setup, const Bytes& data, Bytes& reply) {
  if (setup.request == kSetCurrent) {
    std::copy_n(data.begin(), std::min(data.size(), state.size()), state.begin());
    settle(state);
    if (&state == &commit_) {
      begun_anew_ = true;
      chosen_ = true;
    }
    return true;
  }
  reply = state;
  if (setup.request == kGetLength) reply = {static_cast<std::uint8_t>(kProbeBytes), 0};
  if (setup.request == kGetInfo) reply = {3};
  return true;
}

bool UvcFunction::video_class(const Setup& setup, const Bytes& data, Bytes& reply) {
  const unsigned selector = setup.value >> 8U;
  const unsigned entity = setup.index >> 8U;
  if ((setup.index & 0xffU) == 1) {
    if (selector == 1) return negotiate(probe_, setup, data, reply);
    if (selector == 2) return negotiate(commit_, setup, data, reply);
    return false;
  }
  for (UvcControl& control : controls_) {
    if (control.entity == entity && control.selector == selector) return use(control, setup.request, data, reply);
  }
  if (entity != 0 || selector != 2) return false;
  reply = {6};  // what failed last: no such control
  return true;
}

bool UvcFunction::standard(const Setup& setup, Bytes& reply) {
  enum : unsigned { kGetStatus = 0, kClearFeature = 1, kSetFeature = 3, kSetAddress = 5, kGetDescriptor = 6 };
  enum : unsigned { kGetConfiguration = 8, kSetConfiguration = 9, kGetInterface = 10, kSetInterface = 11 };
  switch (setup.request) {
    case kGetStatus:
      reply = {0, 0};
      return true;
    case kClearFeature:
      begun_anew_ = true;  // of the endpoint's halt
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

}  // namespace ar::testing
