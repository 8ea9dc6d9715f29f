// `skyshaft live` on the webcam, as a user runs it: poses as those of `process` on the same pictures.

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>
#include <utility>

#include "ar/capture/source.h"
#include "tests/lab/lab.h"
#include "tests/lab/webcam.h"

namespace ar::testing {
namespace {

const std::string kProgram = SKYSHAFT_BINARY_DIR "/skyshaft";
const std::string kClip = SKYSHAFT_BINARY_DIR "/lab/clip";  // see tests/lab/make_clip.sh

// The clip's pictures as a webcam gives them.
WebcamStream clip_pictures() {
  WebcamStream stream;
  const auto source = open_source(kClip + ".mp4");
  while (const auto frame = source->next()) {
    stream.width = frame->format.width;
    stream.height = frame->format.height;
    Bytes picture;
    for (int y = 0; y < stream.height; ++y) {
      for (int x = 0; x < stream.width; ++x) {
        const std::size_t chroma = x % 2 == 0 ? 1 : 2;
        picture.push_back(frame->plane[0][y * frame->stride_bytes[0] + x]);
        picture.push_back(frame->plane[chroma][y / 2 * frame->stride_bytes[chroma] + x / 2]);
      }
    }
    stream.pictures.push_back(std::move(picture));
  }
  return stream;
}

struct Pose {
  double position_m[3];
};

// By the number of the frame.
std::map<int, Pose> read_poses(const std::string& path) {
  std::map<int, Pose> poses;
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line.substr(0, 31), "frame,time_s,state,x_m,y_m,z_m,") << path;
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(fields, cell, ',');) cells.push_back(cell);
    if (cells.size() < 6 || cells[2] != "tracking") continue;
    poses[std::stoi(cells[0])] = {{std::stod(cells[3]), std::stod(cells[4]), std::stod(cells[5])}};
  }
  return poses;
}

double distance_m(const Pose& a, const Pose& b) {
  return std::hypot(a.position_m[0] - b.position_m[0], a.position_m[1] - b.position_m[1],
                    a.position_m[2] - b.position_m[2]);
}

// Runs the program beside the test.
pid_t start(const std::string& arguments) {
  const pid_t child = fork();
  if (child != 0) return child;
  execl("/bin/sh", "sh", "-c", ("exec " + kProgram + arguments + " 2>&1").c_str(), nullptr);
  _exit(127);
}

// Processor time that it has used, in the kernel's ticks.
long used_ticks(pid_t process) {
  std::ifstream stat(fmt::format("/proc/{}/stat", process));
  std::string word;
  for (int i = 0; i < 13; ++i) stat >> word;
  long user = 0;
  long system = 0;
  stat >> user >> system;
  return user + system;
}

// Until it does nothing for two seconds: it has set everything up and waits for its first frame.
bool waits(pid_t process) {
  long used = -1;
  return eventually(
      [&] {
        std::this_thread::sleep_for(2s);
        return std::exchange(used, used_ticks(process)) + 5 > used;
      },
      90s);
}

TEST(Program, TracksTheWebcamAsProcessTracksTheSamePictures) {
  Webcam webcam(unplugged({"program", 4, {clip_pictures()}}));
  const std::string node = await_node("uvcvideo");
  webcam.hold_pictures(true);
  const pid_t program = start(fmt::format(
      " live --headless --source v4l2:{0} --duration 9 --poses /tmp/live.csv --scene {1}.scene.yaml --camera "
      "{1}.camera.yaml",
      node, kClip));
  EXPECT_TRUE(waits(program));
  webcam.hold_pictures(false);
  int status = -1;
  waitpid(program, &status, 0);
  EXPECT_EQ(status, 0);
  const std::map<int, Pose> offline = read_poses(kClip + ".poses.csv");
  const std::map<int, Pose> live = read_poses("/tmp/live.csv");
  ASSERT_EQ(offline.size(), 30U);
  double largest_m = 0.0;
  int compared = 0;
  for (const auto& [frame, pose] : live) {
    const auto same = offline.find(frame);
    if (same == offline.end()) continue;  // the webcam begins anew
    ++compared;
    largest_m = std::max(largest_m, distance_m(pose, same->second));
  }
  std::printf("%d poses, at most %.2f mm from those of process\n", compared, largest_m * 1e3);
  EXPECT_GE(compared, 20) << "the lab's machine may drop a few";
  // Where the tags are looked for, and so what is found to a fraction of a pixel, depends on the frames before and on
  // their times. The camera moves 35 mm a frame: each pose must be nearer to its own frame's than to any other's.
  EXPECT_LT(largest_m, 0.017);
}

}  // namespace
}  // namespace ar::testing
