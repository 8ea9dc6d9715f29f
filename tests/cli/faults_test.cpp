// Bad input and faults: each has its status, names what it found, and leaves nothing half written.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

#include "tests/testing/run_program.h"

namespace cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

constexpr const char* kScene =
    "skyshaft: 1\n"
    "place: { latitude: 48.8584, longitude: 2.2945 }\n"
    "time: 2024-06-21T09:30:00Z\n"
    "tags: { size: 0.16, map: [ { id: 3, position: [0, 0, 0], flat: { top_edge_heading_deg: 0 } } ] }\n";

class Faults : public ::testing::Test {
 protected:
  // A clip without any tag.
  std::string plain_clip(int frames) const {
    const std::string path = folder_.path("in.mp4");
    const Result made = run({"ffmpeg", "-v", "error", "-f", "lavfi", "-i", "testsrc=size=320x240:rate=25", "-frames:v",
                             std::to_string(frames), "-pix_fmt", "yuv420p", "-preset", "ultrafast", path});
    EXPECT_EQ(made.status, 0) << made.err;
    return path;
  }

  Result process(const std::string& in, std::vector<std::string> more = {},
                 const std::optional<Kill>& kill = {}) const {
    std::vector<std::string> arguments{
        "process", in, "-o", folder_.path("out.mp4"), "--scene", scene_, "--preset", "ultrafast", "--fov", "60"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return skyshaft(arguments, kill);
  }

  // Sends the signal once the first poses have reached the disk: some frames are through, many are not.
  Kill at_work(int signal) const {
    return {signal, [this] {
              for (const std::string& name : folder_.names()) {
                std::error_code gone;
                const bool poses = name.starts_with("poses.csv.");
                if (poses && std::filesystem::file_size(folder_.path(name), gone) > 0 && !gone) return true;
              }
              return false;
            }};
  }

  // Refused with that status, in two lines at most, and no output.
  void expect_refused(const Result& result, int status, const std::string& what) const {
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_THAT(result.err, HasSubstr(what));
    EXPECT_FALSE(std::filesystem::exists(folder_.path("out.mp4")));
  }

  const Folder folder_;
  const std::string scene_ = folder_.write("scene.yaml", kScene);
};

TEST_F(Faults, UnreadableVideosAreNamed) {
  expect_refused(process(folder_.path("missing.mp4")), 3, "missing.mp4");
  expect_refused(process(folder_.write("empty.mp4", "")), 3, "empty.mp4");
  expect_refused(process(folder_.write("words.mp4", "no video at all, only words\n")), 3, "words.mp4");
}

TEST_F(Faults, ATruncatedVideoWithoutItsIndexIsRefused) {
  const std::string whole = plain_clip(50);
  std::filesystem::resize_file(whole, std::filesystem::file_size(whole) / 2);
  expect_refused(process(whole), 3, "in.mp4");
}

TEST_F(Faults, ATruncatedStreamGivesTheFramesItHolds) {
  const std::string whole = plain_clip(50);
  const std::string stream = folder_.path("in.mkv");
  ASSERT_EQ(run({"ffmpeg", "-v", "error", "-i", whole, "-c", "copy", stream}).status, 0);
  std::filesystem::resize_file(stream, std::filesystem::file_size(stream) * 2 / 3);
  const Result result = process(stream, {"--poses", folder_.path("poses.csv")});
  EXPECT_EQ(result.status, 0) << result.err;
  const std::size_t frames = read_csv(folder_.path("poses.csv")).size() - 1;
  EXPECT_GT(frames, 20U);
  EXPECT_LT(frames, 50U);
}

TEST_F(Faults, AVideoWithoutATagPassesThroughAndSaysSo) {
  const Result result = process(plain_clip(10), {"--poses", folder_.path("poses.csv")});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("no tag"));
  const auto poses = read_csv(folder_.path("poses.csv"));
  ASSERT_EQ(poses.size(), 11U);
  EXPECT_THAT(poses[1], ElementsAre("0", "0.000000", "lost", "", "", "", "", "", "", "", "", ""));
}

TEST_F(Faults, FramesChoosesARange) {
  const Result result = process(plain_clip(20), {"--poses", folder_.path("poses.csv"), "--frames", "5:8"});
  EXPECT_EQ(result.status, 0) << result.err;
  const auto poses = read_csv(folder_.path("poses.csv"));
  ASSERT_EQ(poses.size(), 4U);
  EXPECT_EQ(poses[1][0], "5");
  EXPECT_EQ(poses[1][1], "0.200000");
  EXPECT_EQ(poses[3][0], "7");
}

TEST_F(Faults, ARangePastTheEndIsAnError) {
  expect_refused(process(plain_clip(5), {"--frames", "100:"}), 3, "--frames");
}

TEST_F(Faults, ACameraFileForAnotherResolutionIsRefusedUnlessScaled) {
  const std::string other_aspect = folder_.write("wide.yaml",
                                                 "%YAML:1.0\n---\nimage_width: 1280\nimage_height: 720\n"
                                                 "camera_matrix: !!opencv-matrix\n  rows: 3\n  cols: 3\n  dt: d\n"
                                                 "  data: [1000, 0, 640, 0, 1000, 360, 0, 0, 1]\n");
  const std::string same_aspect = folder_.write("same.yaml",
                                                "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\n"
                                                "camera_matrix: !!opencv-matrix\n  rows: 3\n  cols: 3\n  dt: d\n"
                                                "  data: [600, 0, 320, 0, 600, 240, 0, 0, 1]\n");
  const std::string clip = plain_clip(3);
  const auto with_camera = [&](const std::string& camera, std::vector<std::string> more) {
    std::vector<std::string> arguments{"process", clip, "-o", folder_.path("out.mp4"), "-s", scene_, "-c", camera};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return skyshaft(arguments);
  };
  expect_refused(with_camera(same_aspect, {}), 3, "--scale-camera");
  expect_refused(with_camera(other_aspect, {"--scale-camera"}), 3, "aspect");
  EXPECT_EQ(with_camera(same_aspect, {"--scale-camera"}).status, 0);
}

TEST_F(Faults, ASceneErrorNamesFileLineAndKey) {
  const std::string clip = plain_clip(3);
  folder_.write("scene.yaml", std::string(kScene) + "medium:\n  visibility: 30\n  g: 1.5\n");
  expect_refused(process(clip), 3, "scene.yaml:7: medium.g: found '1.5'");
  folder_.write("scene.yaml", "skyshaft: 1\nplace: { latitude: 1, longitude: 1 }\n");
  expect_refused(process(clip), 3, "tags");
}

TEST_F(Faults, ABrokenModelIsNamedWithTheLineThatAsksForIt) {
  folder_.write("broken.glb", "glTF but not really");
  folder_.write("scene.yaml", std::string(kScene) + "objects: [ { model: broken.glb } ]\n");
  const Result result = process(plain_clip(3));
  expect_refused(result, 3, "scene.yaml:5: objects[0].model");
  EXPECT_THAT(result.err, HasSubstr("broken.glb"));
}

TEST_F(Faults, AnExistingOutputStaysUnlessOverwriteIsGiven) {
  const std::string clip = plain_clip(3);
  folder_.write("out.mp4", "precious");
  Result result = process(clip);
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("--overwrite"));
  EXPECT_EQ(std::filesystem::file_size(folder_.path("out.mp4")), 8U);
  EXPECT_EQ(process(clip, {"--overwrite"}).status, 0);
  EXPECT_GT(std::filesystem::file_size(folder_.path("out.mp4")), 100U);
}

TEST_F(Faults, AnOutputThatIsAnInputOrAnotherOutputIsRefusedBeforeAnythingStarts) {
  const std::string clip = plain_clip(3);
  const auto size = std::filesystem::file_size(clip);
  const std::string link = folder_.path("link.mp4");
  std::filesystem::create_symlink(clip, link);
  std::filesystem::create_hard_link(clip, folder_.path("hard.mp4"));
  const auto expect_same = [&](const std::vector<std::string>& files, const std::string& what) {
    std::vector<std::string> arguments{"process", clip, "--scene", scene_, "--overwrite", "--fov", "60"};
    arguments.insert(arguments.end(), files.begin(), files.end());
    const Result result = skyshaft(arguments);
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(what));
    EXPECT_EQ(std::filesystem::file_size(clip), size);
  };
  expect_same({"-o", clip}, "IN and -o are the same file");
  expect_same({"-o", link}, "IN and -o are the same file");
  expect_same({"-o", folder_.path("hard.mp4")}, "IN and -o are the same file");
  const std::string out = folder_.path("out.mp4");
  expect_same({"-o", out, "--poses", folder_.path("./out.mp4")}, "-o and --poses are the same file");
  expect_same({"-o", out, "--poses", scene_}, "--scene and --poses are the same file");
  expect_same({"-o", out, "--report", clip}, "IN and --report are the same file");
  EXPECT_FALSE(std::filesystem::exists(out));
  EXPECT_GT(std::filesystem::file_size(scene_), 100U);
}

TEST_F(Faults, ADeviceOrPipeIsNotReplaced) {
  const std::string pipe = folder_.path("pipe.csv");
  ASSERT_EQ(run({"mkfifo", pipe}).status, 0);
  const Result result = process(plain_clip(3), {"--poses", pipe, "--overwrite"});
  expect_refused(result, 1, "pipe.csv: is a device or pipe");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST_F(Faults, AnOutputFolderThatDoesNotExistIsNamed) {
  const Result result = skyshaft({"process", plain_clip(3), "-o", folder_.path("no/out.mp4"), "--scene", scene_});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("no folder"));
}

// A limit on file sizes stands for a full disk: the write fails in the same place.
TEST_F(Faults, AFullDiskLeavesAnEarlierOutputAndNothingElse) {
  const std::string clip = plain_clip(200);
  folder_.write("out.mp4", "precious");
  const std::string skyshaft = SKYSHAFT_BINARY_DIR "/skyshaft";
  const Result result =
      run({"bash", "-c", "trap '' XFSZ; ulimit -f 16; exec \"$@\"", "bash", skyshaft, "process", clip, "-o",
           folder_.path("out.mp4"), "--scene", scene_, "--overwrite", "--crf", "0", "--preset", "ultrafast"});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_THAT(result.err, HasSubstr("out.mp4"));
  EXPECT_EQ(std::filesystem::file_size(folder_.path("out.mp4")), 8U);
  EXPECT_THAT(folder_.names(), UnorderedElementsAre("in.mp4", "out.mp4", "scene.yaml"));
}

TEST_F(Faults, AKilledProcessLeavesNoFileUnderTheFinalName) {
  const Result result = process(plain_clip(1500), {"--poses", folder_.path("poses.csv")}, at_work(SIGKILL));
  EXPECT_EQ(result.status, 128 + SIGKILL) << "it ended before it could be killed";
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out.mp4")));
}

TEST_F(Faults, CtrlCFinalisesAPlayableFile) {
  const Result result = process(plain_clip(1500), {"--poses", folder_.path("poses.csv")}, at_work(SIGINT));
  EXPECT_EQ(result.status, 130) << result.err;
  const Result probe = run({"ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames", "-of",
                            "csv=p=0", folder_.path("out.mp4")});
  const std::size_t poses = read_csv(folder_.path("poses.csv")).size() - 1;
  EXPECT_GT(poses, 0U);
  EXPECT_EQ(probe.out, std::to_string(poses) + "\n") << probe.err;
}

TEST_F(Faults, NoSuchGlDeviceSaysWhatToInstall) {
  const Result result = process(plain_clip(3), {"--egl-device", "99"});
  expect_refused(result, 1, "99");
  EXPECT_THAT(result.err, HasSubstr("libegl1"));
}

}  // namespace
}  // namespace cli
