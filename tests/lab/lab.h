#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "ar/capture/devices/open_live_source.h"
#include "tests/lab/uvc_descriptors.h"

// What the tests in the camera lab share. They run inside tests/lab/boot.sh only.
namespace ar::testing {

using namespace std::chrono_literals;

// The node of the first capture (or, `outputs`, output) device of that driver: "vivid", "uvcvideo", "v4l2 loopback".
// Empty where there is none.
std::string node_of(const std::string& driver, bool outputs = false);
// Waits for it, at most 20 s, and for udev to be done with it. Throws std::runtime_error.
std::string await_node(const std::string& driver);

// The model, once the driver has let go of any webcam before it.
const WebcamModel& unplugged(const WebcamModel& next);

// A control by its name as the driver writes it ("Inject Fatal Streaming Error"). Throws std::runtime_error.
void set_control(const std::string& node, const std::string& name, int value);
// Asks a driver directly, behind the source's back.
std::int64_t get_control(const std::string& node, std::uint32_t id);

// Calls `done` until it is true, at most for `patience`.
bool eventually(const std::function<bool()>& done, std::chrono::milliseconds patience = 20s);

// The next frame; fails the test (and gives an empty frame) where none comes in 20 s or the source is lost.
Frame next_frame(LiveSource& source);
// Reads until the source says something else than Frame or Quiet, at most 20 s.
LiveRead read_to_end(LiveSource& source);

// What open_live_source() throws, or empty.
std::string refusal(const std::string& specification, const LiveRequest& request = {});

// A sample of a frame's picture as R'G'B' in 0..255, by the frame's own colour tags.
struct Rgb {
  double r, g, b;
};
Rgb sample(const Frame& frame, int x, int y);

// Pictures that differ, each with its number in it (blocks of black and white).
WebcamStream numbered_pictures(bool mjpeg, int width, int height, int count);
// The number in a frame's picture.
int number_in(const Frame& frame);

// Resident memory that is this process's own (heap, stacks), not pages of libraries, which come as they are called.
std::int64_t own_bytes();
int open_files();

// Keeps the kernel from making huge pages of this process's memory while it lives: that takes 2 MiB at some later
// moment for a stack of which two pages were used, and looks like a leak.
class SmallPages {
 public:
  SmallPages();
  ~SmallPages();
  SmallPages(const SmallPages&) = delete;
  SmallPages& operator=(const SmallPages&) = delete;
};

}  // namespace ar::testing
