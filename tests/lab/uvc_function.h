#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "tests/lab/uvc_descriptors.h"

namespace ar::testing {

// A control of a camera or of its processing, as the USB Video Class has it.
struct UvcControl;

// What a webcam answers to requests on its control endpoint: descriptors, the stream's format, controls.
class UvcFunction {
 public:
  explicit UvcFunction(WebcamModel model);
  ~UvcFunction();
  UvcFunction(const UvcFunction&) = delete;
  UvcFunction& operator=(const UvcFunction&) = delete;

  // The reply to a request of those eight bytes that comes with `data`; nothing where it knows no such request.
  std::optional<Bytes> answer(const std::array<std::uint8_t, 8>& setup, const Bytes& data);

  // What the host has chosen.
  const WebcamStream& stream() const;
  std::chrono::nanoseconds interval() const;
  // The host has begun a stream, or cleared it of an error, since this was last asked.
  bool begun_anew();
  // ... by choosing a format: pictures are due from now on.
  bool chosen();

 private:
  struct Setup;

  bool standard(const Setup& setup, Bytes& reply);
  bool video_class(const Setup& setup, const Bytes& data, Bytes& reply);
  bool negotiate(Bytes& state, const Setup& setup, const Bytes& data, Bytes& reply);
  void settle(Bytes& state) const;

  WebcamModel model_;
  std::vector<UvcControl> controls_;
  Bytes probe_;
  Bytes commit_;
  bool begun_anew_ = false;
  bool chosen_ = false;
};

}  // namespace ar::testing
