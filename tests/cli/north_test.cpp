// `skyshaft north` by the shadow of a pole in a rendered photograph of known place, time and heading.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "ar/track/lens.h"
#include "calib/files/camera_file.h"
#include "tests/testing/run_program.h"

namespace {

using ::testing::HasSubstr;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kTagHeadingDeg = 20.0;
constexpr double kMapTurnedDeg = -37.0;  // the map file has all headings less by that

const cv::Vec3d kEye(-0.6, -3.2, 2.6);
const cv::Vec3d kTarget(-0.1, 0.2, 0.1);
const cv::Vec3d kFoot(0.7, 0.3, 0.0);

constexpr const char* kSpec = R"(skyshaft_synth: 1
size: [640, 480]
samples: 9
noise: 1.0
blur_px: 0.4
place: { latitude: 48.86, longitude: 2.29 }
time: 2024-06-21T07:30:00Z
camera: { fov_deg: 62 }
path: { keyframes: [ { time: 0, position: [-0.6, -3.2, 2.6], target: [-0.1, 0.2, 0.1] } ] }
tags: { family: tag36h11, size: 0.4, map: [ { id: 3, position: [-0.3, -0.6, 0.004], flat: { top_edge_heading_deg: 20 } } ] }
boxes: [ { size: [0.06, 0.06, 1.2], position: [0.7, 0.3, 0.6], surface: concrete } ]
ground: { surface: plain, around: plain }
)";

constexpr const char* kMap = R"(skyshaft_tags: 1
family: tag36h11
map: [ { id: 3, size: 0.4, position: [-0.3, -0.6, 0.004], flat: { top_edge_heading_deg: -17 } } ]
)";

class North : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new cli::Folder;
    const cli::Result made = cli::skyshaft(
        {"synth", folder_->write("pole.yaml", kSpec), "-o", folder_->path("pole_%d.png"), "--frames", "1"});
    ASSERT_EQ(made.status, 0) << made.err;
    camera_ = folder_->path("pole_%d.camera.yaml");
    photo_ = folder_->path("pole_0.png");
    map_ = folder_->write("tags.yaml", kMap);
  }
  static void TearDownTestSuite() { delete folder_; }

  static cv::Point2d seen(const cv::Vec3d& in_world) {
    const cv::Vec3d forward = cv::normalize(kTarget - kEye);
    const cv::Vec3d right = cv::normalize(forward.cross(cv::Vec3d(0.0, 0.0, 1.0)));
    const cv::Vec3d to = in_world - kEye;
    const ar::Lens lens(calib::read_camera_file(camera_));
    return lens.project({right.dot(to), forward.cross(right).dot(to), forward.dot(to)}).value();
  }
  static cv::Vec3d on_ground(double heading_rad) {
    return kFoot + cv::Vec3d(std::sin(heading_rad), std::cos(heading_rad), 0.0);
  }

  // Where the shadow crosses the circle of a metre about the foot, measured in the picture: the middle of the dark arc
  // on the western side, where a morning's shadow falls and the pole itself hides nothing.
  static cv::Point2d shadow_px() {
    cv::Mat picture;
    cv::imread(photo_, cv::IMREAD_GRAYSCALE).convertTo(picture, CV_32F);
    double sum = 0.0;
    double weights = 0.0;
    const double lit = cv::mean(picture)[0];
    for (double heading = 200.0; heading < 340.0; heading += 0.1) {
      const cv::Point2d px = seen(on_ground(heading / kDegrees));
      cv::Mat sample;
      cv::getRectSubPix(picture, {1, 1}, cv::Point2f(px), sample);
      const double dark = std::max(0.0, 0.6 - sample.at<float>(0) / lit);
      sum += dark * heading;
      weights += dark;
    }
    EXPECT_GT(weights, 1.0) << "no shadow in the picture";
    return seen(on_ground(sum / weights / kDegrees));
  }

  static std::vector<std::string> arguments() {
    return {"north", map_,   "--photo",    photo_,   "--camera",
            camera_, "--at", "48.86,2.29", "--time", "2024-06-21T07:30:00Z"};
  }
  static std::string pair(const cv::Point2d& px) { return std::to_string(px.x) + "," + std::to_string(px.y); }

  struct Turn {
    double deg = 0.0;
    double sigma_deg = 0.0;
  };
  static Turn turn_in(const std::string& out) {
    Turn turn;
    const std::size_t at = out.find("turned by ");
    if (at != std::string::npos) std::sscanf(out.c_str() + at, "turned by %lf +- %lf", &turn.deg, &turn.sigma_deg);
    return turn;
  }

  static cli::Folder* folder_;
  static std::string camera_;
  static std::string photo_;
  static std::string map_;
};

cli::Folder* North::folder_ = nullptr;
std::string North::camera_;
std::string North::photo_;
std::string North::map_;

TEST_F(North, IsFoundFromAShadowWithinItsOwnUncertainty) {
  std::vector<std::string> command = arguments();
  const std::string turned = folder_->path("north.yaml");
  command.insert(command.end(), {"--base", pair(seen(kFoot)), "--tip", pair(shadow_px()), "-o", turned});
  const cli::Result result = cli::skyshaft(command);
  ASSERT_EQ(result.status, 0) << result.err;
  const Turn turn = turn_in(result.out);
  EXPECT_GT(turn.sigma_deg, 0.1);
  EXPECT_LT(turn.sigma_deg, 3.0);  // clicks known to 2 px, 150 px apart
  EXPECT_NEAR(turn.deg, -kMapTurnedDeg, turn.sigma_deg);
  const cli::Result again = cli::skyshaft({"north", turned, "--compass", std::to_string(kTagHeadingDeg)});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_NEAR(turn_in(again.out).deg, 0.0, turn.sigma_deg) << "the map that was written faces north";
}

TEST_F(North, WithoutADisplayNamesTheFlagsToGive) {
  const std::string program = SKYSHAFT_BINARY_DIR "/skyshaft";
  std::vector<std::string> command{"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", program};
  const auto rest = arguments();
  command.insert(command.end(), rest.begin(), rest.end());
  const cli::Result result = cli::run(command);
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("--base X,Y and --tip X,Y"));
  std::vector<std::string> half = arguments();
  half.insert(half.end(), {"--base", "10,20"});
  EXPECT_EQ(cli::skyshaft(half).status, 2);
}

// A hand at a virtual screen: clicks the wrong place, takes it back, clicks the foot and the shadow, accepts.
TEST_F(North, TakesTwoClicksInAWindow) {
  if (cli::run({"sh", "-c", "command -v xvfb-run && command -v xdotool"}).status != 0) {
    GTEST_SKIP() << "xvfb and xdotool are not installed";
  }
  const cv::Point2i base = seen(kFoot);
  const cv::Point2i tip = shadow_px();
  const auto click = [](const cv::Point2i& at) {
    return "xdotool mousemove --window $w " + std::to_string(at.x) + " " + std::to_string(at.y) +
           " sleep 0.1 click 1 sleep 0.2\n";
  };
  std::string program = SKYSHAFT_BINARY_DIR "/skyshaft";
  for (const std::string& word : arguments()) program += " '" + word + "'";
  const std::string hand = folder_->write(
      "hand.sh", "w=$(timeout 20 xdotool search --sync --onlyvisible --name 'Skyshaft: shadow' | head -1)\nsleep 1\n" +
                     click({50, 400}) + "xdotool key BackSpace sleep 0.2\n" + click(base) + click(tip) +
                     "xdotool key Return\n");
  const std::string session =
      folder_->write("session.sh", "sh " + hand + " &\ntimeout 40 " + program + "\nstatus=$?\nwait\nexit $status\n");
  const cli::Result result = cli::run({"xvfb-run", "-a", "-s", "-screen 0 1024x768x24", "sh", session});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("clicked --base " + std::to_string(base.x) + ".0," + std::to_string(base.y) +
                                    ".0 --tip " + std::to_string(tip.x) + ".0," + std::to_string(tip.y) + ".0"));
  const Turn turn = turn_in(result.out);
  EXPECT_NEAR(turn.deg, -kMapTurnedDeg, turn.sigma_deg);
}

}  // namespace
