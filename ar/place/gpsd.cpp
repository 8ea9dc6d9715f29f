#include "ar/place/gpsd.h"

#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

namespace ar {
namespace {

constexpr const char* kUsualAddress = "localhost:2947";

class Socket {
 public:
  Socket() = default;
  explicit Socket(int fd) : fd_(fd) {}
  Socket(Socket&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Socket& operator=(Socket&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Socket() {
    if (fd_ >= 0) ::close(fd_);
  }
  int fd() const { return fd_; }

 private:
  int fd_ = -1;
};

Socket connect_to(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  const std::string host = address.substr(0, colon);
  const std::string port = colon == std::string::npos ? "2947" : address.substr(colon + 1);
  addrinfo request{};
  request.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), port.c_str(), &request, &found) != 0) found = nullptr;
  const std::unique_ptr<addrinfo, decltype([](addrinfo* list) {
                          if (list != nullptr) ::freeaddrinfo(list);
                        })>
      addresses(found);
  for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
    Socket socket(::socket(one->ai_family, one->ai_socktype | SOCK_CLOEXEC, one->ai_protocol));
    if (socket.fd() >= 0 && ::connect(socket.fd(), one->ai_addr, one->ai_addrlen) == 0) return socket;
  }
  throw std::runtime_error(
      fmt::format("no gpsd answers at {}\nstart it (apt-get install gpsd), or give the place with --at", address));
}

// A line of gpsd's protocol ("TPV": time, position, velocity) as a position; nothing for all others.
std::optional<GeoPosition> fix_of(const std::string& line) {
  const nlohmann::json report = nlohmann::json::parse(line, nullptr, false);
  if (!report.is_object() || report.value("class", "") != "TPV" || report.value("mode", 0) < 2) return std::nullopt;
  if (!report.contains("lat") || !report.contains("lon")) return std::nullopt;
  // Above mean sea level, as newer and as older daemons call it.
  const double height_m = report.value("altMSL", report.value("alt", 0.0));
  return GeoPosition{report["lat"].get<double>(), report["lon"].get<double>(), height_m};
}

}  // namespace

GeoPosition position_from_gpsd(const std::string& address, std::chrono::milliseconds patience) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point until = Clock::now() + patience;
  const std::string where = address.empty() ? kUsualAddress : address;
  const Socket socket = connect_to(where);
  const std::string watch = "?WATCH={\"enable\":true,\"json\":true};\n";
  std::string received;
  bool open = ::send(socket.fd(), watch.data(), watch.size(), MSG_NOSIGNAL) >= 0;
  while (open) {
    for (std::size_t end = 0; (end = received.find('\n')) != std::string::npos; received.erase(0, end + 1)) {
      if (const auto fix = fix_of(received.substr(0, end))) return *fix;
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
    pollfd ready{.fd = socket.fd(), .events = POLLIN, .revents = 0};
    if (left.count() <= 0 || ::poll(&ready, 1, static_cast<int>(left.count())) <= 0) break;
    char chunk[4096];
    const ssize_t count = ::recv(socket.fd(), chunk, sizeof chunk, 0);
    open = count > 0;
    if (open) received.append(chunk, static_cast<std::size_t>(count));
  }
  throw std::runtime_error(
      fmt::format("gpsd at {} has no fix after {:.0f} s\ncheck the receiver's view of the sky (`cgps`), or give the "
                  "place with --at",
                  where, std::chrono::duration<double>(patience).count()));
}

}  // namespace ar
