// The window of `skyshaft live` on a desktop that nobody sees, used by keys and mouse as a person would.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <future>
#include <iterator>
#include <optional>
#include <thread>

#include "tests/testing/desktop.h"
#include "tests/testing/run_program.h"

namespace cli {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr const char* kProgram = SKYSHAFT_BINARY_DIR "/skyshaft";
constexpr int kScreenWidth = 1000;
constexpr int kScreenHeight = 700;

constexpr const char* kClip = R"(skyshaft_synth: 1
size: [160, 120]
fps: 10
frames: 10
samples: 4
place: { latitude: 48.86, longitude: 2.29 }
time: 2024-06-21T10:00:00Z
camera: { fov_deg: 60 }
path: { orbit: { center: [0, 0, 0], radius: 2, height: 1.5, from_deg: 180, to_deg: 180.1 } }
tags:
  family: tag36h11
  size: 0.6
  map: [ { id: 3, position: [0, 0, 0.01], flat: { top_edge_heading_deg: 0 } } ]
ground: { surface: plain, around: plain }
)";

constexpr const char* kScene = R"(skyshaft: 1
# a remark
place: { latitude: 48.86, longitude: 2.29 }
time: 2024-06-21T10:00:00Z
exposure: { white_luminance: 13000 }
tags: { size: 0.6, map: [ { id: 3, position: [0, 0, 0.01], flat: { top_edge_heading_deg: 0 } } ] }
objects: [ { model: )" SKYSHAFT_SOURCE_DIR R"(/data/models/post.glb, position: [0.5, 0, 0] } ]
real: [ { plane: ground } ]
)";

std::string read_text(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool eventually(const std::function<bool()>& so) {
  const auto end = std::chrono::steady_clock::now() + 20s;
  while (!so()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(100ms);
  }
  return true;
}

bool is_black(const Screenshot::Pixel& pixel) {
  return pixel == Screenshot::Pixel{0, 0, 0};
}

// The smallest rectangle that holds all that is not black: nothing in the clip is.
Rectangle lit_part(const Screenshot& shot) {
  int left = shot.width;
  int top = shot.height;
  int right = -1;
  int bottom = -1;
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      if (is_black(shot.at(x, y))) continue;
      left = std::min(left, x);
      top = std::min(top, y);
      right = std::max(right, x);
      bottom = std::max(bottom, y);
    }
  }
  return {left, top, right - left + 1, bottom - top + 1};
}

bool differ(const Screenshot::Pixel& a, const Screenshot::Pixel& b) {
  int off = 0;
  for (std::size_t i = 0; i < 3; ++i) off = std::max(off, std::abs(a.at(i) - b.at(i)));
  return off > 24;
}

// Part of the rectangle that differs clearly.
double difference(const Screenshot& a, const Screenshot& b, const Rectangle& in) {
  int differing = 0;
  for (int y = in.y; y < in.y + in.height; ++y) {
    for (int x = in.x; x < in.x + in.width; ++x) {
      if (differ(a.at(x, y), b.at(x, y))) ++differing;
    }
  }
  return static_cast<double>(differing) / (in.width * in.height);
}

// Where the post stands before the plain ground.
constexpr Rectangle kPost{420, 0, 80, 200};

bool shows_post(const Screenshot& shot) {
  int marked = 0;
  for (int y = kPost.y; y < kPost.y + kPost.height; ++y) {
    for (int x = kPost.x; x < kPost.x + kPost.width; ++x) {
      if (differ(shot.at(x, y), shot.at(630, 470))) ++marked;
    }
  }
  return marked > kPost.width * kPost.height / 10;
}

class Window : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!Desktop::available()) return;
    folder_ = new Folder;
    const std::string clip = folder_->path("clip.mp4");
    const Result made = skyshaft({"synth", folder_->write("clip.yaml", kClip), "-o", clip});
    ASSERT_EQ(made.status, 0) << made.err;
    const Result longer =
        run({"ffmpeg", "-v", "error", "-stream_loop", "60", "-i", clip, "-c", "copy", folder_->path("long.mp4")});
    ASSERT_EQ(longer.status, 0) << longer.err;
  }
  static void TearDownTestSuite() { delete folder_; }

  void SetUp() override {
    if (!Desktop::available()) GTEST_SKIP() << "there is no Xvfb (package xvfb)";
    desktop_.emplace(kScreenWidth, kScreenHeight);
    scene_ = folder_->write("scene.yaml", kScene);
    program_ = std::async(std::launch::async, [this] {
      return run({"env", "-u", "WAYLAND_DISPLAY", "DISPLAY=" + desktop_->name(), kProgram, "live", "--source",
                  "file:" + folder_->path("long.mp4"), "--scene", scene_, "--camera", folder_->path("clip.camera.yaml"),
                  "--target-ms", "0", "--stills", folder_->path("")},
                 Kill{SIGKILL, [this] { return hopeless_.load(); }});
    });
    const auto ended = [this] { return program_.wait_for(0s) == std::future_status::ready; };
    ASSERT_TRUE(eventually([&] { return ended() || desktop_->has_window("Skyshaft: "); }));
    ASSERT_FALSE(ended()) << program_.get().err;
    window_ = desktop_->take_window("Skyshaft: ");
    EXPECT_TRUE(eventually([this] {
      const Screenshot shot = desktop_->screenshot();
      return lit_part(shot) == Rectangle{0, 0, 640, 480} && shows_post(shot);
    })) << "the window, four times as large as the clip, with the post";
  }

  void TearDown() override {
    hopeless_ = true;
    if (program_.valid()) program_.wait();
  }

  // Waits until the picture, without the panel, covers that part of the screen and nothing else.
  bool shows_in(const Rectangle& expected) {
    Rectangle found;
    const bool so = eventually([&] {
      found = lit_part(desktop_->screenshot());
      return std::abs(found.x - expected.x) < 2 && std::abs(found.y - expected.y) < 2 &&
             std::abs(found.width - expected.width) < 3 && std::abs(found.height - expected.height) < 3;
    });
    EXPECT_TRUE(so) << found.width << "x" << found.height << " at " << found.x << ", " << found.y;
    return so;
  }

  bool changes(const Screenshot& before, const Rectangle& in, double part) {
    return eventually([&] { return difference(before, desktop_->screenshot(), in) > part; });
  }

  void expect_end() {
    ASSERT_EQ(program_.wait_for(20s), std::future_status::ready);
    const Result result = program_.get();
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("frames shown"));
  }

  static Folder* folder_;
  std::optional<Desktop> desktop_;
  std::string scene_;
  std::atomic<bool> hopeless_ = false;
  std::future<Result> program_;
  Desktop::Window window_ = 0;
};

Folder* Window::folder_ = nullptr;

TEST_F(Window, KeepsThePicturesShapeBetweenBlackBarsAndFillsTheScreen) {
  desktop_->press("p");
  desktop_->resize(window_, 300, 600);
  EXPECT_TRUE(shows_in({0, 188, 300, 225}));
  desktop_->resize(window_, 900, 300);
  EXPECT_TRUE(shows_in({250, 0, 400, 300}));
  const Rectangle before = desktop_->place_of(window_);
  desktop_->press("f");
  EXPECT_TRUE(shows_in({33, 0, 933, 700}));
  EXPECT_EQ(desktop_->place_of(window_), (Rectangle{0, 0, kScreenWidth, kScreenHeight}));
  desktop_->press("F11");
  EXPECT_TRUE(shows_in({250, 0, 400, 300}));
  EXPECT_EQ(desktop_->place_of(window_), before);
  desktop_->ask_to_close(window_);
  expect_end();
}

// Where the panel lies, and the slider of the time of day in it at about half past five.
constexpr Rectangle kPanel{10, 10, 350, 460};
constexpr Rectangle kBesidePanel{370, 10, 260, 460};
constexpr Rectangle kMiddle{200, 190, 240, 100};
constexpr int kHoursX = 60;
constexpr int kHoursY = 173;

TEST_F(Window, KeysShowThePanelAndHelpAndWriteAStill) {
  const Screenshot with_panel = desktop_->screenshot();
  desktop_->press("p");
  EXPECT_TRUE(changes(with_panel, kPanel, 0.5));
  const Screenshot bare = desktop_->screenshot();
  EXPECT_LT(difference(with_panel, bare, kBesidePanel), 0.03) << "but for the edges of what moves";
  desktop_->press("h");
  EXPECT_TRUE(changes(bare, kMiddle, 0.5)) << "the keys";
  desktop_->press("h");
  EXPECT_TRUE(eventually([&] { return difference(bare, desktop_->screenshot(), kMiddle) < 0.03; }));
  desktop_->press("s");
  std::string still;
  EXPECT_TRUE(eventually([&] {
    for (const std::string& name : folder_->names()) {
      if (name.starts_with("skyshaft-") && name.ends_with(".png")) still = folder_->path(name);
    }
    return !still.empty();
  }));
  desktop_->press("q");
  expect_end();
  const Result probed =
      run({"ffprobe", "-v", "error", "-show_entries", "stream=width,height", "-of", "csv=p=0", still});
  EXPECT_EQ(probed.out, "160,120\n") << "the still has the clip's size, not the window's";
}

TEST_F(Window, TheSliderMovesTheSunAndTheChangeGoesIntoTheSceneFile) {
  const Screenshot before = desktop_->screenshot();
  desktop_->click(kHoursX, kHoursY);
  EXPECT_TRUE(changes(before, kBesidePanel, 0.02)) << "another light on the post";
  desktop_->press("w");
  EXPECT_TRUE(eventually([&] { return read_text(scene_).find("T10:00:00Z") == std::string::npos; }));
  const std::string scene = read_text(scene_);
  EXPECT_THAT(scene, HasSubstr("time: 2024-06-21T05:"));
  EXPECT_THAT(scene, HasSubstr("# a remark\nplace: { latitude: 48.86"));
  desktop_->press("q");
  expect_end();
}

}  // namespace
}  // namespace cli
