#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "ar/capture/live/camera_mode.h"

namespace ar::v4l2 {

// An open video node (/dev/video0). Its errors are InputError: one line of what, one of what to do.
class Device {
 public:
  // Throws where there is no such node, no permission, nothing behind it, or it is no video device.
  explicit Device(std::filesystem::path node);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  // As ioctl(2), repeated where a signal interrupted it. Returns 0 or the errno.
  int call(unsigned long request, void* argument) const noexcept;
  // As call(), but throws, naming `request_name`, where it fails.
  void require(unsigned long request, void* argument, const char* request_name) const;

  int descriptor() const { return descriptor_; }
  const std::filesystem::path& node() const { return node_; }
  const std::string& card() const { return card_; }          // "Integrated Camera"
  const std::string& bus_info() const { return bus_info_; }  // "usb-0000:00:14.0-3": where it is plugged in
  const std::string& driver() const { return driver_; }
  bool captures() const;  // streams pictures from a camera
  bool outputs() const;   // takes pictures, one memory plane a picture
  // V4L2_BUF_TYPE_VIDEO_CAPTURE, or ..._MPLANE where the driver speaks of a picture's planes one by one.
  std::uint32_t capture_type() const;

 private:
  std::filesystem::path node_;
  int descriptor_ = -1;
  std::uint32_t capabilities_ = 0;
  std::string card_;
  std::string bus_info_;
  std::string driver_;
};

// What went wrong with a device, from the errno of `doing` ("VIDIOC_STREAMON"), and what to do about it.
std::string explain(const std::filesystem::path& node, const std::string& doing, int error_number);

// Every mode of a capture device; of sizes that change in steps, those that people ask for.
std::vector<CameraMode> list_modes(const Device& device, const LiveRequest& request = {});

// Video nodes, in the order of their numbers.
std::vector<std::filesystem::path> list_nodes();

// The node that `address` names: itself, where it is a path; empty, the first camera with a format that can be decoded;
// "bus=INFO", the camera plugged in there. Throws InputError where there is none.
std::filesystem::path resolve(const std::string& address);

// What finds the same camera again: udev's link by the camera's name and serial number or, without, by its place of
// plugging; else "bus=INFO".
std::string stable_address(const Device& device);

}  // namespace ar::v4l2
