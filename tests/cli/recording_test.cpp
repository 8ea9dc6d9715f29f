// A real recording through the whole program.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <sstream>

#include "tests/testing/run_program.h"

namespace cli {
namespace {

constexpr const char* kFolder = SKYSHAFT_SHARED_DATA "/video_single_tag";

// Timestamps of all frames. ffprobe puts commas and empty lines where a frame has side data.
std::vector<long> video_times(const std::string& path) {
  const Result probed =
      run({"ffprobe", "-v", "error", "-select_streams", "v:0", "-show_entries", "frame=pts", "-of", "csv=p=0", path});
  std::vector<long> times;
  std::istringstream lines(probed.out);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) times.push_back(std::stol(line));
  }
  return times;
}

// Frames of the clip in which the reference detections list the tag: rows of file,frame,family,id,...
std::set<std::string> frames_with_tag(const std::string& file, const std::string& id) {
  std::set<std::string> frames;
  for (const auto& row : read_csv(std::string(kFolder) + "/measured_detections.csv")) {
    if (row[0] == file && row[3] == id) frames.insert(row[1]);
  }
  return frames;
}

TEST(Recording, KeepsEveryFrameAndTimeAndFindsThePoses) {
  const std::string clip = std::string(kFolder) + "/rit_tag36h11_id3_640x480.mp4";
  if (!std::filesystem::exists(clip)) GTEST_SKIP() << clip << " is not here";
  const Folder folder;
  const std::string scene =
      folder.write("scene.yaml",
                   "skyshaft: 1\n"
                   "place: { latitude: 43.0845, longitude: -77.6749 }\n"
                   "time: 2019-07-01T16:00:00Z\n"
                   "tags: { size: 0.16, map: [ { id: 3, position: [0, 0, 1], wall: { faces_heading_deg: 180 } } ] }\n");
  const std::string out = folder.path("out.mp4");
  const Result result = skyshaft({"process", clip, "-o", out, "--scene", scene, "--fov", "60", "--preset", "ultrafast",
                                  "--poses", folder.path("poses.csv")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(video_times(out), video_times(clip));

  const auto poses = read_csv(folder.path("poses.csv"));
  EXPECT_EQ(poses.size(), 703U);
  const std::set<std::string> listed = frames_with_tag("rit_tag36h11_id3_640x480.mp4", "3");
  ASSERT_GT(listed.size(), 600U) << "the reference detections were not understood";
  std::size_t posed = 0;
  for (const auto& row : poses) {
    if (listed.contains(row[0]) && row[2] != "lost") ++posed;
  }
  EXPECT_GE(static_cast<double>(posed), 0.95 * static_cast<double>(listed.size()));
}

}  // namespace
}  // namespace cli
