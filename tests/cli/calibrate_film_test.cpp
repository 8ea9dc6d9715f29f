// `skyshaft calibrate` on a recording in which a board is moved about, sometimes held still, sometimes shaken; and the
// same recording played as if a camera gave it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <string>
#include <vector>

#include "calib/files/camera_file.h"
#include "tests/testing/board_film.h"
#include "tests/testing/run_program.h"

namespace {

using calib::HeldView;
using calib::Reach;
using calib::Tilt;
using calib::testing::film_board;
using calib::testing::pose_held;
using calib::testing::Stay;
using ::testing::HasSubstr;

constexpr const char* kBoard = "aprilgrid:5x4:30mm:0.3";
constexpr double kFocal = 350.0;

calib::Board board() {
  calib::GridSpec grid;
  grid.columns = 5;
  grid.rows = 4;
  grid.size_m = 0.03;
  grid.gap_x_m = grid.gap_y_m = 0.009;
  return calib::make_tag_grid(grid);
}

ar::CameraModel true_camera() {
  return calib::camera_of(calib::LensChoice::PlumbBob4, {kFocal, 351.5, 202.5, 146.5, -0.18, 0.05, 0.001, -0.0005}, 400,
                          300);
}

class Film : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new cli::Folder;
    clip_ = folder_->path("board.mp4");
    const calib::Board grid = board();
    const ar::CameraModel camera = true_camera();
    const std::vector<HeldView> views{
        {1, 1, Tilt::Facing, Reach::Near},        {0, 0, Tilt::LeftNearer, Reach::Near},
        {2, 2, Tilt::TopNearer, Reach::Near},     {2, 0, Tilt::RightNearer, Reach::Near},
        {0, 2, Tilt::BottomNearer, Reach::Near},  {1, 1, Tilt::TopNearer, Reach::Middle},
        {2, 1, Tilt::LeftNearer, Reach::Middle},  {0, 1, Tilt::RightNearer, Reach::Middle},
        {1, 0, Tilt::BottomNearer, Reach::Near},  {1, 2, Tilt::LeftNearer, Reach::Near},
        {0, 0, Tilt::BottomNearer, Reach::Middle}};
    std::vector<Stay> stays;
    for (const HeldView& view : views) stays.push_back({.camera_from_board = pose_held(grid, camera, view)});
    for (const std::size_t shaky : {5U, 7U}) stays[shaky].shake_px = 10.0;  // 250 px/s at its fastest
    film_board(clip_, grid, camera, stays, {});
  }
  static void TearDownTestSuite() { delete folder_; }

  static cli::Folder* folder_;
  static std::string clip_;
};

cli::Folder* Film::folder_ = nullptr;
std::string Film::clip_;

TEST_F(Film, OfAMovingBoardGivesItsStillSharpAndDifferentViews) {
  const std::string camera = folder_->path("camera.yaml");
  const cli::Result result = cli::skyshaft({"calibrate", "-q", clip_, "--board", kBoard, "--lens", "plumb-bob-4", "-o",
                                            camera, "--views", "20", "--report", folder_->path("film.html")});
  ASSERT_EQ(result.status, 0) << result.out << result.err;
  const ar::CameraModel found = calib::read_camera_file(camera);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(found.intrinsics(i, i), true_camera().intrinsics(i, i), 0.005 * kFocal);
  }
  const auto note = calib::read_camera_note(camera);
  ASSERT_TRUE(note.has_value());
  EXPECT_GE(note->views, 8);
  EXPECT_LE(note->views, 20) << "of 110 frames";
  EXPECT_THAT(result.out, HasSubstr("verdict      good"));
}

TEST_F(Film, PlayedLiveIsCalibratedFromViewsThatWereHeldStill) {
  const std::string camera = folder_->path("live.yaml");
  const cli::Result result = cli::skyshaft(
      {"calibrate", "--live", "file:" + clip_, "--headless", "--board", kBoard, "--lens", "plumb-bob-4", "-o", camera});
  const auto note = calib::read_camera_note(camera);
  ASSERT_TRUE(note.has_value()) << result.out << result.err;
  // Nine views are held still; a busy machine may miss some, and then the judge may want more.
  EXPECT_GE(note->views, 5) << result.err;
  EXPECT_LE(note->views, 9) << result.err;
  EXPECT_EQ(result.status, 0) << result.err;
  const ar::CameraModel found = calib::read_camera_file(camera);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(found.intrinsics(i, i), true_camera().intrinsics(i, i), 0.005 * kFocal);
  }
  EXPECT_THAT(result.err, HasSubstr("hold the board in the"));
  EXPECT_THAT(result.err, HasSubstr("view 1 taken: in the middle, facing the camera, near"));
  EXPECT_THAT(result.err, HasSubstr("% of the picture"));
}

// "the board in 40 of 52 pictures": 52.
int pictures_in(const std::string& out) {
  const std::size_t at = out.find(" of ", out.find("the board in "));
  return at == std::string::npos ? -1 : std::stoi(out.substr(at + 4));
}

TEST_F(Film, CtrlCSolvesWithTheViewsSoFar) {
  const auto start = std::chrono::steady_clock::now();
  const auto later = [start] { return std::chrono::steady_clock::now() - start > std::chrono::seconds(4); };
  const cli::Result result =
      cli::skyshaft({"calibrate", "--live", "file:" + clip_, "--headless", "--board", kBoard, "--lens", "pinhole"},
                    cli::Kill{SIGINT, later});
  EXPECT_EQ(result.status, 4) << "few views are not enough; " << result.err;
  EXPECT_THAT(result.out, HasSubstr("verdict      rejected"));
  EXPECT_GT(pictures_in(result.out), 5);
  EXPECT_LT(pictures_in(result.out), 100);
}

TEST_F(Film, EnterInTheWindowSolvesWithTheViewsSoFar) {
  if (cli::run({"sh", "-c", "command -v xvfb-run && command -v xdotool"}).status != 0) {
    GTEST_SKIP() << "xvfb and xdotool are not installed";
  }
  const std::string hand = folder_->write(
      "hand.sh",
      "timeout 20 xdotool search --sync --onlyvisible --name 'Skyshaft: calibrating'\nsleep 4\nxdotool key Return\n");
  const std::string session = folder_->write(
      "session.sh", "sh " + hand + " >&2 &\ntimeout 40 " SKYSHAFT_BINARY_DIR "/skyshaft calibrate --live file:" +
                        clip_ + " --board " + kBoard + " --lens pinhole\nstatus=$?\nwait\nexit $status\n");
  const cli::Result result = cli::run({"xvfb-run", "-a", "-s", "-screen 0 1024x768x24", "sh", session});
  EXPECT_EQ(result.status, 4) << result.err;
  EXPECT_GT(pictures_in(result.out), 5);
  EXPECT_LT(pictures_in(result.out), 100);
}

TEST(CalibrateLive, WithoutADisplaySaysWhatToDo) {
  const cli::Folder folder;
  const std::string clip = folder.path("any.mp4");
  ASSERT_EQ(
      cli::run({"ffmpeg", "-v", "error", "-f", "lavfi", "-i", "testsrc=size=64x48:rate=10:duration=1", clip}).status,
      0);
  const std::string program = SKYSHAFT_BINARY_DIR "/skyshaft";
  const cli::Result result = cli::run({"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", program, "calibrate", "--live",
                                       "file:" + clip, "--board", kBoard});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("--headless"));
  const cli::Result empty = cli::skyshaft({"calibrate", "--live", "file:" + clip, "--headless", "--board", kBoard});
  EXPECT_EQ(empty.status, 3);
  EXPECT_THAT(empty.err, HasSubstr("no view of the board was taken"));
  EXPECT_EQ(cli::skyshaft({"calibrate", "--board", kBoard}).status, 2);
}

}  // namespace
