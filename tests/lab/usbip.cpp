#include "tests/lab/usbip.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>

namespace ar::testing::usbip {
namespace {

constexpr const char* kController = "/sys/devices/platform/vhci_hcd.0";
constexpr std::uint32_t kSubmit = 1;
constexpr std::uint32_t kUnlink = 2;
constexpr std::uint32_t kSubmitted = 3;
constexpr std::uint32_t kDropped = 4;
constexpr std::size_t kHeader = 12;  // words

// The first free port for high-speed devices, or `wanted` if it is one; -1.
int free_port(int wanted) {
  std::ifstream status(fmt::format("{}/status", kController));
  for (std::string line; std::getline(status, line);) {
    std::istringstream fields(line);
    std::string hub;
    int port = -1;
    std::string state;
    fields >> hub >> port >> state;
    const bool free = hub == "hs" && state == "004";
    if (free && (wanted < 0 || port == wanted)) return port;
  }
  return -1;
}

int await_port(int wanted) {
  for (int tries = 0; tries < 100; ++tries) {
    if (const int port = free_port(wanted); port >= 0) return port;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  throw std::runtime_error("no free port at the virtual USB host controller: is vhci-hcd loaded?");
}

void send_all(int socket, const void* data, std::size_t size) {
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  while (size > 0) {
    const ssize_t sent = send(socket, bytes, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) throw std::runtime_error(fmt::format("USB/IP: send: {}", std::strerror(errno)));
    bytes += sent;
    size -= static_cast<std::size_t>(sent);
  }
}

void receive_all(int socket, void* data, std::size_t size) {
  auto* bytes = static_cast<std::uint8_t*>(data);
  while (size > 0) {
    const ssize_t got = recv(socket, bytes, size, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw std::runtime_error("USB/IP: the controller hung up");
    bytes += got;
    size -= static_cast<std::size_t>(got);
  }
}

}  // namespace

Port::Port(int wanted) : number_(await_port(wanted)) {
  int ends[2] = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) throw std::runtime_error("no socket");
  socket_ = ends[0];
  constexpr int kDevice = 0x10001;  // bus and number that the device has where it really is
  constexpr int kHighSpeed = 3;
  std::ofstream attach(fmt::format("{}/attach", kController));
  attach << fmt::format("{} {} {} {}", number_, ends[1], kDevice, kHighSpeed) << std::flush;
  close(ends[1]);  // the controller keeps its own hold on it
  if (!attach) {
    close(socket_);
    throw std::runtime_error("cannot plug into the virtual USB host controller (are you root?)");
  }
}

Port::~Port() {
  close(socket_);
}

Request Port::receive() const {
  std::array<std::uint32_t, kHeader> words{};
  receive_all(socket_, words.data(), sizeof words);
  Request request;
  request.unlink = ntohl(words[0]) == kUnlink;
  if (!request.unlink && ntohl(words[0]) != kSubmit) throw std::runtime_error("USB/IP: an unknown request");
  request.number = ntohl(words[1]);
  request.to_host = ntohl(words[3]) == 1;
  request.endpoint = ntohl(words[4]);
  request.unlinked = ntohl(words[5]);
  request.length = ntohl(words[6]);
  std::memcpy(request.setup.data(), &words[10], request.setup.size());
  if (!request.unlink && !request.to_host) {
    request.data.resize(request.length);
    receive_all(socket_, request.data.data(), request.data.size());
  }
  return request;
}

void Port::answer(const Request& request, std::int32_t status, std::span<const std::uint8_t> data,
                  std::uint32_t taken) const {
  std::array<std::uint32_t, kHeader> words{};
  words[0] = htonl(kSubmitted);
  words[1] = htonl(request.number);
  words[5] = htonl(static_cast<std::uint32_t>(status));
  words[6] = htonl(request.to_host ? static_cast<std::uint32_t>(data.size()) : taken);
  send_all(socket_, words.data(), sizeof words);
  if (request.to_host) send_all(socket_, data.data(), data.size());
}

void Port::answer_unlink(const Request& request, bool dropped) const {
  std::array<std::uint32_t, kHeader> words{};
  words[0] = htonl(kDropped);
  words[1] = htonl(request.number);
  words[5] = htonl(static_cast<std::uint32_t>(dropped ? kUnlinked : 0));
  send_all(socket_, words.data(), sizeof words);
}

}  // namespace ar::testing::usbip
