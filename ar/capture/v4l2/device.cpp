#include "ar/capture/v4l2/device.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <grp.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "ar/error.h"

namespace ar::v4l2 {
namespace {

namespace fs = std::filesystem;

template <std::size_t N>
std::string text(const unsigned char (&field)[N]) {
  const auto* begin = reinterpret_cast<const char*>(field);
  return {begin, strnlen(begin, N)};
}

std::string no_permission(const fs::path& node) {
  struct stat status {};
  const bool known = stat(node.c_str(), &status) == 0;
  const bool by_group =
      known && status.st_gid != 0 && (status.st_mode & S_IRGRP) != 0 && (status.st_mode & S_IWGRP) != 0;
  if (known && !by_group) {
    return fmt::format("cannot open {}: no permission\nGive yourself some: sudo setfacl -m u:$USER:rw {}.",
                       node.string(), node.string());
  }
  const group* owner = known ? getgrgid(status.st_gid) : nullptr;
  const std::string name = owner != nullptr ? owner->gr_name : known ? fmt::format("{}", status.st_gid) : "video";
  return fmt::format(
      "cannot open {}: no permission; it belongs to group {}\nJoin that group (sudo usermod -aG {} $USER) and log in "
      "again.",
      node.string(), name, name);
}

}  // namespace

std::string explain(const fs::path& node, const std::string& doing, int error_number) {
  switch (error_number) {
    case ENOENT:
      return fmt::format(
          "cannot open {}: no such device\nPlug it in; `skyshaft live --list-cameras` lists what is here.",
          node.string());
    case EACCES:
    case EPERM:
      return no_permission(node);
    case EBUSY:
      return fmt::format("cannot use {}: another program is using it\nClose that program; `fuser -v {}` names it.",
                         node.string(), node.string());
    case ENODEV:
    case ENXIO:
      return fmt::format("cannot use {}: the device behind it is gone\nPlug it in again.", node.string());
    case ENOSPC:
      return fmt::format(
          "cannot use {}: its USB bus has no room for this stream\nAsk for a smaller size or rate, or plug it into "
          "another port.",
          node.string());
    case ENOTTY:
      return fmt::format(
          "cannot use {}: it is no video device\nGive one such as /dev/video0; `skyshaft live --list-cameras` lists "
          "what is here.",
          node.string());
    default:
      return fmt::format("cannot use {}: {} failed: {} ({})\nPlug it in again, and see what `dmesg` says.",
                         node.string(), doing, std::strerror(error_number), strerrorname_np(error_number));
  }
}

Device::Device(fs::path node) : node_(std::move(node)) {
  descriptor_ = open(node_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) throw InputError(explain(node_, "open", errno));
  v4l2_capability capability{};
  if (const int error = call(VIDIOC_QUERYCAP, &capability); error != 0) {
    close(descriptor_);
    throw InputError(explain(node_, "VIDIOC_QUERYCAP", error == EINVAL ? ENOTTY : error));
  }
  const bool has_own = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0;
  capabilities_ = has_own ? capability.device_caps : capability.capabilities;
  card_ = text(capability.card);
  bus_info_ = text(capability.bus_info);
  driver_ = text(capability.driver);
}

Device::~Device() {
  close(descriptor_);
}

int Device::call(unsigned long request, void* argument) const noexcept {
  for (;;) {
    if (ioctl(descriptor_, request, argument) != -1) return 0;
    if (errno != EINTR) return errno;
  }
}

void Device::require(unsigned long request, void* argument, const char* request_name) const {
  if (const int error = call(request, argument); error != 0) throw InputError(explain(node_, request_name, error));
}

bool Device::captures() const {
  constexpr std::uint32_t kEither = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_VIDEO_CAPTURE_MPLANE;
  return (capabilities_ & kEither) != 0 && (capabilities_ & V4L2_CAP_STREAMING) != 0;
}

bool Device::outputs() const {
  return (capabilities_ & V4L2_CAP_VIDEO_OUTPUT) != 0 && (capabilities_ & V4L2_CAP_STREAMING) != 0;
}

std::uint32_t Device::capture_type() const {
  const bool single = (capabilities_ & V4L2_CAP_VIDEO_CAPTURE) != 0;
  return single ? V4L2_BUF_TYPE_VIDEO_CAPTURE : V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
}

std::vector<fs::path> list_nodes() {
  std::vector<std::pair<int, fs::path>> numbered;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/sys/class/video4linux", error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("video")) numbered.emplace_back(std::atoi(name.c_str() + 5), fs::path("/dev") / name);
  }
  std::sort(numbered.begin(), numbered.end());
  std::vector<fs::path> nodes;
  for (auto& [number, node] : numbered) nodes.push_back(std::move(node));
  return nodes;
}

fs::path resolve(const std::string& address) {
  const bool by_bus = address.starts_with("bus=");
  if (!by_bus && !address.empty()) return address;
  std::string refused;  // why the first camera that is there cannot be had
  for (const fs::path& node : list_nodes()) {
    try {
      const Device device(node);
      if (!device.captures()) continue;
      if (by_bus ? device.bus_info() == address.substr(4) : choose_mode(list_modes(device), {}).has_value())
        return node;
    } catch (const InputError& error) {
      if (refused.empty()) refused = error.what();
    }
  }
  if (!refused.empty()) throw InputError(refused);
  throw InputError(fmt::format(
      "{}\nPlug one in, or play a recording: --source file:CLIP.",
      by_bus ? fmt::format("no camera is plugged in at {}", address.substr(4)) : "there is no camera (V4L2)"));
}

std::string stable_address(const Device& device) {
  std::error_code error;
  const fs::path node = fs::canonical(device.node(), error);
  for (const char* folder : {"/dev/v4l/by-id", "/dev/v4l/by-path"}) {
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (fs::canonical(entry.path(), error) == node) return entry.path().string();
    }
  }
  return device.bus_info().empty() ? node.string() : "bus=" + device.bus_info();
}

}  // namespace ar::v4l2
