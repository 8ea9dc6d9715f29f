#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "tests/lab/uvc_descriptors.h"

namespace ar::testing::usbip {

// One request of the host's controller, as Documentation/usb/usbip_protocol.rst lays it out.
struct Request {
  bool unlink = false;
  std::uint32_t number = 0;
  bool to_host = false;
  unsigned endpoint = 0;
  std::uint32_t length = 0;             // bytes asked for, or brought along in `data`
  std::array<std::uint8_t, 8> setup{};  // of endpoint 0
  std::uint32_t unlinked = 0;           // of an unlink: the request to be dropped
  Bytes data;
};

inline constexpr std::int32_t kStalled = -32;    // EPIPE
inline constexpr std::int32_t kUnlinked = -104;  // ECONNRESET

// The socket between the kernel's virtual host controller and a device of ours, plugged into one of its ports.
class Port {
 public:
  // Takes a free high-speed port, or `wanted` as soon as it is free. Throws std::runtime_error.
  explicit Port(int wanted = -1);
  ~Port();
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  int number() const { return number_; }
  int descriptor() const { return socket_; }
  Request receive() const;
  void answer(const Request& request, std::int32_t status, std::span<const std::uint8_t> data = {},
              std::uint32_t taken = 0) const;
  void answer_unlink(const Request& request, bool dropped) const;

 private:
  int number_;
  int socket_ = -1;
};

}  // namespace ar::testing::usbip
