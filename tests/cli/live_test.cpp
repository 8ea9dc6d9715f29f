// `skyshaft live` with a clip played as if a camera gave it, as a user runs it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/testing/run_program.h"

namespace cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kProgram = SKYSHAFT_BINARY_DIR "/skyshaft";

// Ten frames a second of so few pixels that no machine has to drop any.
constexpr const char* kClip = R"(skyshaft_synth: 1
size: [256, 192]
fps: 10
frames: 30
samples: 4
place: { latitude: 48.86, longitude: 2.29 }
time: 2024-06-21T10:00:00Z
camera: { fov_deg: 60 }
path: { orbit: { center: [0, 0, 0], radius: 2, height: 1.5, from_deg: 180, to_deg: 190 } }
tags:
  family: tag36h11
  size: 0.6
  map: [ { id: 3, position: [0, 0, 0.01], flat: { top_edge_heading_deg: 0 } } ]
ground: { surface: plain, around: plain }
)";

// A post whose shadow falls on the ground; no air, so that drawing takes little.
constexpr const char* kScene = R"(skyshaft: 1
place: { latitude: 48.86, longitude: 2.29 }
time: 2024-06-21T10:00:00Z
tags: { size: 0.6, map: [ { id: 3, position: [0, 0, 0.01], flat: { top_edge_heading_deg: 0 } } ] }
objects: [ { model: )" SKYSHAFT_SOURCE_DIR R"(/data/models/post.glb, position: [0.5, 0, 0] } ]
real: [ { plane: ground } ]
)";

class Live : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new Folder;
    clip_ = folder_->path("clip.mp4");
    const Result made = skyshaft({"synth", folder_->write("clip.yaml", kClip), "-o", clip_});
    ASSERT_EQ(made.status, 0) << made.err;
    scene_ = folder_->write("scene.yaml", kScene);
  }
  static void TearDownTestSuite() { delete folder_; }

  static Result live(std::vector<std::string> more, const std::optional<Kill>& kill = {}) {
    std::vector<std::string> arguments{"live", "--headless", "--scene",
                                       scene_, "--camera",   folder_->path("clip.camera.yaml")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return skyshaft(arguments, kill);
  }

  static nlohmann::json report(const std::string& path) { return nlohmann::json::parse(std::ifstream(path)); }

  static int frames_in(const std::string& video) {
    const Result probed = run(
        {"ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames", "-of", "csv=p=0", video});
    return probed.out.empty() ? 0 : std::stoi(probed.out);
  }

  // Once the recording holds its first second.
  static Kill while_recording(int signal, const std::string& video) {
    return {signal, [video] {
              std::error_code gone;
              return std::filesystem::file_size(video, gone) > 4000 && !gone;
            }};
  }

  static Folder* folder_;
  static std::string clip_;
  static std::string scene_;
};

Folder* Live::folder_ = nullptr;
std::string Live::clip_;
std::string Live::scene_;

TEST_F(Live, DrawsEachFrameFromThePoseThatProcessFindsInIt) {
  const std::string offline = folder_->path("offline.csv");
  const Result processed =
      skyshaft({"process", clip_, "-o", folder_->path("offline.mp4"), "--scene", scene_, "--camera",
                folder_->path("clip.camera.yaml"), "--preset", "ultrafast", "--poses", offline});
  ASSERT_EQ(processed.status, 0) << processed.err;
  const std::string poses = folder_->path("live.csv");
  const std::string facts = folder_->path("live.json");
  const std::string video = folder_->path("live.mkv");
  const Result result = live({"--source", "file:" + clip_, "--poses", poses, "--report", facts, "--record", video});
  ASSERT_EQ(result.status, 0) << result.err;

  const nlohmann::json told = report(facts);
  if (told["frames"]["dropped_before_tracking"] > 0) GTEST_SKIP() << "too busy to track ten small frames a second";
  EXPECT_EQ(read_csv(poses), read_csv(offline));
  EXPECT_EQ(told["frames"]["captured"], 30);
  EXPECT_EQ(told["frames"]["tracking"], 30);
  const int presented = told["frames"]["presented"];
  const int dropped = told["frames"]["dropped"];
  EXPECT_EQ(presented + dropped, 30);
  EXPECT_GT(presented, 0);
  EXPECT_EQ(frames_in(video), presented);
  EXPECT_EQ(told["latency_ms"]["frames"], presented);
}

TEST_F(Live, EndsAfterItsDuration) {
  const std::string facts = folder_->path("short.json");
  const Result result = live({"--source", "file:" + clip_, "--duration", "0.35", "--report", facts});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_LT(report(facts)["frames"]["presented"], 30);
}

TEST_F(Live, CtrlCFinalisesTheRecording) {
  const std::string video = folder_->path("stopped.mp4");
  const std::string facts = folder_->path("stopped.json");
  const Result result = live({"--source", "file:" + clip_, "--record", video, "--codec", "hevc", "--report", facts},
                             while_recording(SIGINT, video));
  EXPECT_EQ(result.status, 130) << result.err;
  EXPECT_EQ(frames_in(video), report(facts)["frames"]["recorded"]);
}

TEST_F(Live, AKilledRecordingPlays) {
  for (const std::string name : {"killed.mp4", "killed.mkv"}) {
    const std::string video = folder_->path(name);
    const Result result = live({"--source", "file:" + clip_, "--record", video}, while_recording(SIGKILL, video));
    EXPECT_EQ(result.status, 128 + SIGKILL) << name << ": it ended before it could be killed";
    EXPECT_GT(frames_in(video), 0) << name;
  }
}

// All that is said but for information: one line of what is wrong, one of what to do.
void expect_clear(const Result& result, int status, const std::string& what, const std::string& remedy) {
  EXPECT_EQ(result.status, status) << result.err;
  EXPECT_EQ(result.out, "");
  std::vector<std::string> lines;
  std::istringstream in(result.err);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("info: ")) lines.push_back(line);
  }
  ASSERT_EQ(lines.size(), 2U) << result.err;
  EXPECT_THAT(lines[0], StartsWith("skyshaft: "));
  EXPECT_THAT(lines[0], HasSubstr(what));
  EXPECT_THAT(lines[1], HasSubstr(remedy));
}

TEST_F(Live, WhatCannotBeHadIsOneClearLineAndOneOfWhatToDo) {
  expect_clear(live({"--source", "v4l2:/dev/video97"}), 3, "cannot open /dev/video97: no such device",
               "--list-cameras");
  expect_clear(live({"--source", "v4l2:/dev/null"}), 3, "cannot use /dev/null: it is no video device", "/dev/video0");
  expect_clear(live({"--source", "libcamera:none"}), 3, "libcamera", "v4l2:");
  expect_clear(live({"--source", "file:" + clip_, "--egl-device", "99"}), 1, "99", "libegl1");
  expect_clear(live({"--source", "file:" + clip_, "--output", "v4l2:/dev/video97"}), 3, "/dev/video97: no such device",
               "sudo modprobe v4l2loopback video_nr=97");
  expect_clear(live({"--source", "file:" + clip_, "--gpsd", "127.0.0.1:1"}), 1, "127.0.0.1:1", "--at");
  expect_clear(live({}), 2, "--source", "--list-cameras");
}

TEST_F(Live, WhatIsNotUnderstoodIsRefused) {
  const auto refused = [](const std::vector<std::string>& arguments, int status, const std::string& what) {
    const Result result = live(arguments);
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_THAT(result.err, HasSubstr(what));
  };
  refused({"--source", "camera"}, 3, "v4l2:");
  refused({"--source", "file:" + folder_->path("none.mp4")}, 3, "none.mp4");
  refused({"--source", "file:" + clip_, "--record", clip_}, 2, "--source and --record are the same file");
  refused({"--source", "file:" + clip_, "--size", "wide"}, 2, "WIDTHxHEIGHT");
  refused({"--source", "file:" + clip_, "--control", "zoom=3"}, 2, "exposure");
}

TEST_F(Live, WithoutADisplayOrAGpuItSaysWhatToDo) {
  const auto in = [](std::vector<std::string> command, const std::vector<std::string>& more) {
    command.insert(command.begin(), {"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY"});
    command.insert(command.end(), {kProgram, "live", "--source", "file:" + clip_, "--scene", scene_, "--camera",
                                   folder_->path("clip.camera.yaml")});
    command.insert(command.end(), more.begin(), more.end());
    return run(command);
  };
  expect_clear(in({}, {}), 1, "no display", "--headless");
  expect_clear(in({"DISPLAY=:9973"}, {}), 1, ":9973", "--headless");
  expect_clear(in({"__EGL_VENDOR_LIBRARY_DIRS=/nonexistent"}, {"--headless"}), 1, "no OpenGL ES", "libgl1-mesa-dri");
}

TEST_F(Live, WithoutPermissionItSaysHowToGetIt) {
  const std::string node = folder_->write("node", "");
  std::filesystem::permissions(node, std::filesystem::perms::none);
  std::filesystem::permissions(folder_->path(""), std::filesystem::perms{0755});
  std::vector<std::string> command{kProgram, "live", "--headless", "--source", "v4l2:" + node, "--scene", scene_};
  // Nothing is forbidden to root.
  const std::vector<std::string> nobody{"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"};
  if (geteuid() == 0) {
    command.insert(command.begin(), nobody.begin(), nobody.end());
    if (run({"setpriv", nobody[1], nobody[2], nobody[3], "test", "-x", command[4]}).status != 0) {
      GTEST_SKIP() << "user 65534 may not run what is built here";
    }
  }
  expect_clear(run(command), 3, "cannot open " + node + ": no permission", "setfacl");
}

}  // namespace
}  // namespace cli
