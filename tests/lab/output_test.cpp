// The V4L2 output device: written as other programs' webcam, and read back as one of them would.

#include <algorithm>
#include <cmath>
#include <cstring>

#include "ar/capture/devices/camera_list.h"
#include "ar/output/v4l2/v4l2_sink.h"
#include "tests/lab/lab.h"

namespace ar::testing {
namespace {

SourceInfo made_source(int width, int height, ColorMatrix matrix) {
  SourceInfo source;
  source.format = {width, height, 8, Chroma::C422, {matrix, ColorRange::Limited, Transfer::Bt709, Primaries::Bt709}};
  source.frame_rate = {30, 1};
  return source;
}

// A picture of one colour but for its number, in the top row of blocks.
void paint(OutputFrame& frame, int number) {
  const std::uint8_t values[] = {100, 90, 200};
  for (std::size_t plane = 0; plane < 3; ++plane) {
    const int width = plane == 0 ? frame.format.width : frame.format.width / 2;
    for (int y = 0; y < frame.format.height; ++y) {
      std::memset(frame.plane[plane] + y * frame.stride_bytes[plane], values[plane], static_cast<std::size_t>(width));
    }
  }
  for (int x = 0; x < frame.format.width; ++x) {
    const bool set = (number >> (x * 10 / frame.format.width) & 1) != 0;
    for (int y = 0; y < frame.format.height / 2; ++y) {
      frame.plane[0][y * frame.stride_bytes[0] + x] = set ? 235 : 16;
    }
  }
}

class Loopback : public ::testing::TestWithParam<const char*> {
 protected:
  std::string node_ = node_of("v4l2 loopback", true);
};

TEST_P(Loopback, WhatIsWrittenIsReadBack) {
  const SourceInfo source = made_source(320, 240, ColorMatrix::Bt601);
  const auto sink = open_v4l2_sink(node_, source, std::string(GetParam()));
  const auto send = [&](int number) {
    OutputFrame frame = sink->allocate();
    paint(frame, number);
    sink->write(std::move(frame), number);
  };
  send(0);  // a loopback device is a camera once it has had a picture
  const auto camera = open_live_source("v4l2:" + node_, {});
  EXPECT_EQ(camera->info().codec, GetParam());
  ASSERT_EQ(camera->info().format.width, 320);
  for (int number = 1; number < 100; ++number) {
    send(number);
    Frame frame = next_frame(*camera);
    while (number_in(frame) < number) frame = next_frame(*camera);  // it repeats the last to who comes late
    ASSERT_EQ(number_in(frame), number);
    EXPECT_EQ(frame.plane[0][200 * frame.stride_bytes[0] + 100], 100);
    const int chroma_y = frame.format.chroma == Chroma::C420 ? 100 : 200;
    EXPECT_EQ(frame.plane[1][chroma_y * frame.stride_bytes[1] + 50], 90);
    EXPECT_EQ(frame.plane[2][chroma_y * frame.stride_bytes[2] + 50], 200);
  }
  sink->finish();
}

INSTANTIATE_TEST_SUITE_P(, Loopback, ::testing::Values("YUYV", "NV12"),
                         [](const auto& test) { return std::string(test.param); });

TEST(OutputDevice, ThatIsNotThereComesWithTheLineThatMakesIt) {
  const SourceInfo source = made_source(320, 240, ColorMatrix::Bt709);
  const auto why = [&](const std::string& address) -> std::string {
    try {
      open_v4l2_sink(address, source);
      return {};
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  };
  EXPECT_NE(why("/dev/video77").find("no such device\n"), std::string::npos);
  EXPECT_NE(why("/dev/video77").find("sudo modprobe v4l2loopback video_nr=77 card_label=Skyshaft exclusive_caps=1"),
            std::string::npos);
  EXPECT_NE(why(node_of("vivid")).find("it takes no pictures\n"), std::string::npos) << why(node_of("vivid"));
}

TEST(OutputDevice, ThatIsSlowNeverHoldsThePipelineUp) {
  // vivid's output shows its own size at its own rate: pictures are scaled, and left out where they come too fast.
  const auto sink = open_v4l2_sink(node_of("vivid", true), made_source(320, 240, ColorMatrix::Bt709));
  const auto begin = std::chrono::steady_clock::now();
  for (int number = 0; number < 30; ++number) sink->write(sink->allocate(), number);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 10s);
  sink->finish();
}

TEST(CameraList, NamesEveryCameraWithItsModes) {
  bool vivid = false;
  for (const CameraListing& camera : list_cameras()) {
    EXPECT_NE(camera.source, "v4l2:" + node_of("vivid", true)) << "an output is no camera";
    if (camera.source != "v4l2:" + node_of("vivid")) continue;
    vivid = true;
    EXPECT_EQ(camera.name, "vivid");
    EXPECT_EQ(camera.problem, "");
    const auto offered = [&](const std::string& format, int width, int height, double fastest) {
      return std::any_of(camera.modes.begin(), camera.modes.end(), [&](const CameraMode& mode) {
        return mode.format == format && mode.width == width && mode.height == height &&
               std::abs(mode.rates.front() - fastest) < 0.01;
      });
    };
    EXPECT_TRUE(offered("YUYV", 640, 360, 40.0));
    EXPECT_TRUE(offered("NV12", 1920, 1080, 5.0));
  }
  EXPECT_TRUE(vivid);
}

}  // namespace
}  // namespace ar::testing
