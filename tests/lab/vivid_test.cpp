// V4L2 capture from the kernel's virtual video driver: every raw format, and every fault that it can inject.

#include <fmt/format.h>
#include <grp.h>
#include <linux/videodev2.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "ar/capture/v4l2/device.h"
#include "tests/lab/lab.h"
#include "tests/lab/running_program.h"

namespace ar::testing {
namespace {

using std::chrono::steady_clock;

class Vivid : public ::testing::Test {
 protected:
  Vivid() { set_control(node_, "OSD Text Mode", 2); }  // no letters in the picture
  std::string node() const { return node_; }
  std::string specification() const { return "v4l2:" + node_; }
  std::unique_ptr<LiveSource> open(const std::string& format = "YUYV") const {
    return open_live_source(specification(), {320, 180, 60, format});
  }

 private:
  std::string node_ = node_of("vivid");
};

// vivid's bars of 75 % (SMPTE EG 1), in R'G'B' of 0..255.
constexpr Rgb kBars[] = {{191, 191, 191}, {191, 191, 0}, {0, 191, 191}, {0, 191, 0},
                         {191, 0, 191},   {191, 0, 0},   {0, 0, 191},   {0, 0, 0}};

void expect_bars(const Frame& frame, bool grey) {
  ASSERT_EQ(frame.format.width, 640);
  ASSERT_EQ(frame.format.height, 360);
  for (int bar = 0; bar < 8; ++bar) {
    const Rgb& bars = kBars[bar];
    const double luma = 0.2126 * bars.r + 0.7152 * bars.g + 0.0722 * bars.b;  // vivid's grey is BT.709's
    const Rgb expected = grey ? Rgb{luma, luma, luma} : bars;
    const Rgb found = sample(frame, 40 + 80 * bar, 180);
    // 8-bit YCbCr of limited range is good to 2 levels of R'G'B'.
    EXPECT_NEAR(found.r, expected.r, 3.0) << "bar " << bar;
    EXPECT_NEAR(found.g, expected.g, 3.0) << "bar " << bar;
    EXPECT_NEAR(found.b, expected.b, 3.0) << "bar " << bar;
  }
}

class VividFormat : public Vivid, public ::testing::WithParamInterface<const char*> {};

TEST_P(VividFormat, GivesTheBarsInTheirColours) {
  const std::string format = GetParam();
  const auto source = open_live_source(specification(), {640, 360, 25, format});
  EXPECT_EQ(source->info().codec, format);
  EXPECT_NEAR(static_cast<double>(source->info().frame_rate.num) / source->info().frame_rate.den, 25.0, 1e-6);
  expect_bars(next_frame(*source), format == "GREY");
}

INSTANTIATE_TEST_SUITE_P(, VividFormat, ::testing::Values("YU12", "NV12", "YUYV", "UYVY", "RGB3", "BGR3", "GREY"),
                         [](const auto& test) { return std::string(test.param); });

// The second vivid speaks of planes only (V4L2's multi-planar interface).
std::string node_of_planes() {
  for (const auto& node : v4l2::list_nodes()) {
    const v4l2::Device device(node);
    const bool several = device.capture_type() == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
    if (device.driver() == "vivid" && device.captures() && several) return node.string();
  }
  return {};
}

class VividPlanes : public ::testing::TestWithParam<const char*> {};

TEST_P(VividPlanes, GivesTheBarsInTheirColours) {
  const std::string node = node_of_planes();
  set_control(node, "OSD Text Mode", 2);  // no letters in the picture
  const std::string format = GetParam();
  auto source = open_live_source("v4l2:" + node, {640, 360, 25, format});
  EXPECT_EQ(source->info().codec, format);
  std::vector<Frame> held;
  for (int i = 0; i < 9; ++i) held.push_back(next_frame(*source));  // more than there are buffers
  source.reset();
  for (const Frame& frame : held) expect_bars(frame, format == "GREY");
}

INSTANTIATE_TEST_SUITE_P(, VividPlanes,
                         ::testing::Values("YU12", "NV12", "YUYV", "UYVY", "RGB3", "BGR3", "GREY", "YM12", "NM12"),
                         [](const auto& test) { return std::string(test.param); });

TEST_F(Vivid, FramesCarryTheDriversTimeInTheSystemsClock) {
  const auto source = open();
  double last_s = 0.0;
  for (int i = 0; i < 20; ++i) {
    const Frame frame = next_frame(*source);
    const double now_s = std::chrono::duration<double>(steady_clock::now().time_since_epoch()).count();
    EXPECT_GT(frame.time_s, last_s);
    EXPECT_GE(now_s - frame.time_s, 0.0);
    EXPECT_LT(now_s - frame.time_s, 2.0);
    EXPECT_NEAR(frame.time_s, static_cast<double>(frame.pts) * 1e-6, 1e-9);
    EXPECT_EQ(frame.index, i);
    EXPECT_NEAR(frame.duration_s, 1.0 / 60.0, 1e-6);
    last_s = frame.time_s;
  }
}

TEST_F(Vivid, LoansOutliveTheSourceAndDoNotKeepTheCameraBusy) {
  std::vector<Frame> held;
  auto source = open("YU12");
  for (int i = 0; i < 12; ++i) held.push_back(next_frame(*source));  // more than there are buffers
  source.reset();
  EXPECT_EQ(refusal(specification()), "");
  unsigned sum = 0;
  for (const Frame& frame : held) sum += frame.plane[0][90 * frame.stride_bytes[0] + 20] > 150 ? 1 : 0;
  EXPECT_EQ(sum, held.size()) << "the first bar is white in each of them";
}

TEST_F(Vivid, ASecondClientIsTurnedAwayAndToldWhatToDo) {
  const auto source = open();
  next_frame(*source);
  const std::string why = refusal(specification());
  EXPECT_NE(why.find(node() + ": another program is using it\n"), std::string::npos) << why;
  EXPECT_NE(why.find("fuser"), std::string::npos) << why;
  next_frame(*source);
}

TEST_F(Vivid, WithoutPermissionItNamesTheGroupToJoin) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    const bool dropped =
        setgroups(0, nullptr) == 0 && setresgid(65534, 65534, 65534) == 0 && setresuid(65534, 65534, 65534) == 0;
    const std::string why = dropped ? refusal(specification()) : "still root";
    _exit(write(ends[1], why.data(), why.size()) < 0 ? 1 : 0);
  }
  close(ends[1]);
  char text[1000] = {};
  EXPECT_GT(read(ends[0], text, sizeof text - 1), 0);
  close(ends[0]);
  waitpid(child, nullptr, 0);
  EXPECT_NE(std::string(text).find("no permission; it belongs to group video\n"), std::string::npos) << text;
  EXPECT_NE(std::string(text).find("usermod -aG video"), std::string::npos) << text;
}

// What the program says of a camera that it cannot have: two lines.
void expect_refused(const std::string& node, const std::string& through, const std::string& what) {
  RunningProgram program(fmt::format("live --headless --source v4l2:{} --scene {}.scene.yaml", node, lab_clip()),
                         "/tmp/refused.log", through);
  EXPECT_EQ(program.status(), 3);
  const std::string log = program.log();
  EXPECT_TRUE(log.starts_with("skyshaft: " + what)) << log;
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 2) << log;
}

TEST_F(Vivid, TheProgramIsTurnedAwayWithStatus3AndTwoLines) {
  // Root that may not do what only root may: it reads what the program needs, wherever that lies, and owns the node.
  ASSERT_EQ(chmod(node().c_str(), 0060), 0);
  expect_refused(node(), "setpriv --bounding-set=-dac_override,-dac_read_search ",
                 fmt::format("cannot open {}: no permission; it belongs to group video\nJoin", node()));
  ASSERT_EQ(chmod(node().c_str(), 0660), 0);
  const auto source = open();
  next_frame(*source);
  expect_refused(node(), "", fmt::format("cannot use {}: another program is using it\nClose", node()));
}

TEST_F(Vivid, WhatIsNoCameraIsRefusedInOneLineWithWhatToDo) {
  EXPECT_NE(refusal("v4l2:/dev/video99").find("cannot open /dev/video99: no such device\n"), std::string::npos);
  EXPECT_NE(refusal("v4l2:/dev/null").find("it is no video device\n"), std::string::npos);
  EXPECT_NE(refusal("v4l2:" + node_of("vivid", true)).find("it gives no pictures to programs\n"), std::string::npos);
  EXPECT_NE(refusal(specification(), {{}, {}, {}, "H264"}).find(", not H264\n"), std::string::npos);
  EXPECT_NE(refusal("camera:0").find("no source is called 'camera:0'\n"), std::string::npos);
}

TEST_F(Vivid, TheFirstCameraIsOneThatGivesPictures) {
  const auto source = open_live_source("v4l2:", {});
  EXPECT_NE(source->info().name.find(node()), std::string::npos) << source->info().name;
}

TEST_F(Vivid, AFrameMarkedBrokenIsSkippedAndCounted) {
  const auto source = open();
  next_frame(*source);
  set_control(node(), "Inject V4L2_BUF_FLAG_ERROR", 1);
  for (int i = 0; i < 20; ++i) next_frame(*source);
  EXPECT_EQ(source->counts().damaged, 1);
}

TEST_F(Vivid, AnErrorWhileStartingIsNamedAndTheNextStartWorks) {
  const std::pair<const char*, const char*> faults[] = {{"Inject VIDIOC_REQBUFS Error", "VIDIOC_REQBUFS"},
                                                        {"Inject VIDIOC_QBUF Error", "VIDIOC_QBUF"},
                                                        {"Inject VIDIOC_STREAMON Error", "VIDIOC_STREAMON"}};
  for (const auto& [control, name] : faults) {
    set_control(node(), control, 1);
    const std::string why = refusal(specification());
    EXPECT_NE(why.find(fmt::format("{} failed: Invalid argument (EINVAL)\n", name)), std::string::npos) << why;
    EXPECT_EQ(refusal(specification()), "");
  }
}

TEST_F(Vivid, ABufferThatTheDriverRefusedOnceIsGivenBackAgain) {
  const auto source = open();
  for (int round = 0; round < 8; ++round) {  // more often than there are buffers
    set_control(node(), "Inject VIDIOC_QBUF Error", 1);
    for (int i = 0; i < 3; ++i) next_frame(*source);
  }
}

TEST_F(Vivid, AFatalErrorLosesTheStreamWhichCanBeOpenedAgain) {
  auto source = open();
  const std::string identity = source->identity();
  next_frame(*source);
  set_control(node(), "Inject Fatal Streaming Error", 1);
  const LiveRead end = read_to_end(*source);
  EXPECT_EQ(end.status, LiveStatus::Lost);
  EXPECT_NE(end.reason.find("(EIO)"), std::string::npos) << end.reason;
  source.reset();
  next_frame(*open_live_source(identity, {}));
}

TEST_F(Vivid, ADisconnectedCameraIsLostAndComesBackUnderItsIdentity) {
  auto source = open("YU12");
  const std::string identity = source->identity();
  Frame held = next_frame(*source);
  set_control(node(), "Disconnect", 1);
  const LiveRead end = read_to_end(*source);
  EXPECT_EQ(end.status, LiveStatus::Lost);
  EXPECT_NE(end.reason.find("the camera is gone"), std::string::npos) << end.reason;
  source.reset();
  held = {};  // vivid comes back once nobody holds anything of it
  ASSERT_TRUE(eventually([&] { return refusal(identity).empty(); })) << refusal(identity);
  next_frame(*open_live_source(identity, {}));
}

TEST_F(Vivid, DroppedBuffersAreCountedAsMissed) {
  const auto source = open();
  next_frame(*source);
  set_control(node(), "Percentage of Dropped Buffers", 50);
  for (int i = 0; i < 30; ++i) next_frame(*source);
  set_control(node(), "Percentage of Dropped Buffers", 0);
  EXPECT_GT(source->counts().missed, 5);
  EXPECT_EQ(source->counts().damaged, 0);
}

// Frames until `received` of them came and `patience` is over; their times must rise and be of the system's clock.
void expect_rising_times(LiveSource& source, int frames, std::chrono::seconds patience) {
  double last_s = 0.0;
  const auto begin = steady_clock::now();
  for (int i = 0; i < frames || steady_clock::now() - begin < patience; ++i) {
    const Frame frame = next_frame(source);
    const double age_s = std::chrono::duration<double>(steady_clock::now().time_since_epoch()).count() - frame.time_s;
    ASSERT_GT(frame.time_s, last_s);
    ASSERT_GE(age_s, 0.0);
    ASSERT_LT(age_s, 3.0);
    last_s = frame.time_s;
  }
}

TEST_F(Vivid, ASequenceThatWrapsIsNoGap) {
  set_control(node(), "Wrap Sequence Number", 1);  // it begins 128 before its wrap
  const auto source = open();
  expect_rising_times(*source, 150, 0s);
  EXPECT_LT(source->counts().missed, 100) << "a wrap taken for a gap counts in thousands of millions";
  set_control(node(), "Wrap Sequence Number", 0);
}

TEST_F(Vivid, TimesThatWrapOrAreOfAnotherClockStillRise) {
  for (const auto& [wrap, patience] : {std::pair{1, 18s}, {2, 2s}}) {  // they begin 16 s before their wrap
    set_control(node(), "Wrap Timestamp", wrap);
    expect_rising_times(*open(), 0, patience);
  }
  set_control(node(), "Wrap Timestamp", 0);
}

}  // namespace
}  // namespace ar::testing
