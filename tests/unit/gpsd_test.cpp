// A daemon of our own that speaks gpsd's protocol.

#include "ar/place/gpsd.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>
#include <thread>

namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using namespace std::chrono_literals;

// Answers one client with that text once it asked, in two pieces, and keeps silent then.
class FakeGpsd {
 public:
  explicit FakeGpsd(std::string answer) : answer_(std::move(answer)), listener_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address);
    ::listen(listener_, 1);
    socklen_t size = sizeof address;
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~FakeGpsd() {
    ::shutdown(listener_, SHUT_RDWR);
    thread_.join();
    ::close(listener_);
  }
  FakeGpsd(const FakeGpsd&) = delete;
  FakeGpsd& operator=(const FakeGpsd&) = delete;

  std::string address() const { return fmt::format("127.0.0.1:{}", port_); }

 private:
  void serve() const {
    const int client = ::accept(listener_, nullptr, nullptr);
    if (client < 0) return;
    char request[256];
    if (::recv(client, request, sizeof request, 0) > 0) {
      const std::size_t half = answer_.size() / 2;
      ::send(client, answer_.data(), half, MSG_NOSIGNAL);
      std::this_thread::sleep_for(20ms);
      ::send(client, answer_.data() + half, answer_.size() - half, MSG_NOSIGNAL);
      ::recv(client, request, sizeof request, 0);  // until the client goes
    }
    ::close(client);
  }

  std::string answer_;
  int listener_;
  int port_ = 0;
  std::thread thread_;
};

constexpr const char* kVersion =
    "{\"class\":\"VERSION\",\"release\":\"3.22\"}\n{\"class\":\"TPV\",\"mode\":1}\nnot JSON\n";

TEST(Gpsd, TakesTheFirstFix) {
  const FakeGpsd gpsd(std::string(kVersion) +
                      "{\"class\":\"TPV\",\"mode\":3,\"lat\":43.5263,\"lon\":5.4454,\"altMSL\":180.5}\n");
  const ar::GeoPosition position = ar::position_from_gpsd(gpsd.address(), 2s);
  EXPECT_DOUBLE_EQ(position.latitude_deg, 43.5263);
  EXPECT_DOUBLE_EQ(position.longitude_deg, 5.4454);
  EXPECT_DOUBLE_EQ(position.height_m, 180.5);
}

TEST(Gpsd, SaysWhatToDoWithoutAFixOrADaemon) {
  const FakeGpsd gpsd(kVersion);
  EXPECT_THAT([&] { ar::position_from_gpsd(gpsd.address(), 150ms); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no fix")));
  EXPECT_THAT([] { ar::position_from_gpsd("127.0.0.1:1", 150ms); },
              ThrowsMessage<std::runtime_error>(HasSubstr("--at")));
}

}  // namespace
