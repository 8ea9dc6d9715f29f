// A camera's controls read, set, locked and let go again, seen from behind by asking the driver.

#include <linux/videodev2.h>

#include "ar/capture/live/camera_controls.h"
#include "tests/lab/lab.h"
#include "tests/lab/webcam.h"

namespace ar::testing {
namespace {

class WebcamControls : public ::testing::Test {
 protected:
  std::int64_t driver(std::uint32_t id) const { return get_control(node_, id); }
  std::unique_ptr<LiveSource> open(const std::vector<std::string>& settings) const {
    LiveRequest request;
    for (const std::string& text : settings) request.controls.push_back(parse_control_setting(text));
    return open_live_source("v4l2:" + node_, request);
  }

  Webcam webcam_{unplugged({"controls", 30, {numbered_pictures(false, 64, 48, 2)}})};
  std::string node_ = await_node("uvcvideo");
};

TEST_F(WebcamControls, AreReadWithTheirRangesInTheirUnits) {
  const auto source = open({});
  const auto exposure = source->controls()->read(CameraControl::Exposure);
  ASSERT_TRUE(exposure);
  EXPECT_DOUBLE_EQ(exposure->value, 0.0156);
  EXPECT_DOUBLE_EQ(exposure->minimum, 0.0001);
  EXPECT_DOUBLE_EQ(exposure->maximum, 0.5);
  EXPECT_TRUE(exposure->can_be_automatic);
  EXPECT_TRUE(exposure->automatic);
  const auto gain = source->controls()->read(CameraControl::Gain);
  ASSERT_TRUE(gain);
  EXPECT_DOUBLE_EQ(gain->value, 10.0);
  EXPECT_FALSE(gain->can_be_automatic);
  const auto white = source->controls()->read(CameraControl::WhiteBalance);
  ASSERT_TRUE(white);
  EXPECT_DOUBLE_EQ(white->maximum, 6500.0);
  EXPECT_FALSE(next_frame(*source).exposure.exposure_s) << "nobody knows it while it is automatic";
}

TEST_F(WebcamControls, AreSetWhenTheCameraIsOpened) {
  const auto source = open({"exposure=0.01", "gain=200", "focus=101", "white-balance=5000"});
  EXPECT_EQ(driver(V4L2_CID_EXPOSURE_AUTO), V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(driver(V4L2_CID_EXPOSURE_ABSOLUTE), 100);
  EXPECT_EQ(driver(V4L2_CID_GAIN), 100) << "no more than there is";
  EXPECT_EQ(driver(V4L2_CID_FOCUS_AUTO), 0);
  EXPECT_EQ(driver(V4L2_CID_FOCUS_ABSOLUTE), 100) << "on the camera's step";
  EXPECT_EQ(driver(V4L2_CID_AUTO_WHITE_BALANCE), 0);
  EXPECT_EQ(driver(V4L2_CID_WHITE_BALANCE_TEMPERATURE), 5000);
  EXPECT_DOUBLE_EQ(next_frame(*source).exposure.exposure_s.value_or(0.0), 0.01);
}

TEST_F(WebcamControls, StayAsTheyAreWhenLockedAndAreAutomaticAgainWhenLetGo) {
  const auto source = open({"exposure=lock", "white-balance=lock"});
  EXPECT_EQ(driver(V4L2_CID_EXPOSURE_AUTO), V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(driver(V4L2_CID_EXPOSURE_ABSOLUTE), 156);
  EXPECT_EQ(driver(V4L2_CID_AUTO_WHITE_BALANCE), 0);
  EXPECT_DOUBLE_EQ(next_frame(*source).exposure.exposure_s.value_or(0.0), 0.0156);
  EXPECT_TRUE(source->controls()->set_automatic(CameraControl::Exposure, true));
  EXPECT_EQ(driver(V4L2_CID_EXPOSURE_AUTO), V4L2_EXPOSURE_APERTURE_PRIORITY);
  EXPECT_FALSE(next_frame(*source).exposure.exposure_s);
}

TEST_F(WebcamControls, ThatACameraLacksAreRefusedWithWhatItHas) {
  try {
    open({"gain=auto"});
    ADD_FAILURE() << "this camera's gain cannot be automatic";
  } catch (const std::runtime_error& error) {
    const std::string why = error.what();
    EXPECT_NE(why.find("cannot let gain be automatic of " + node_), std::string::npos) << why;
    EXPECT_NE(why.find("exposure 0.0001 to 0.5 s or auto, gain 0 to 100, focus"), std::string::npos) << why;
  }
}

TEST(VividControls, AutomaticGainIsLockedAndSet) {
  const std::string node = node_of("vivid");
  const auto source = open_live_source("v4l2:" + node, {});
  CameraControls& controls = *source->controls();
  EXPECT_TRUE(controls.set_automatic(CameraControl::Gain, true));
  EXPECT_TRUE(controls.read(CameraControl::Gain)->automatic);
  EXPECT_TRUE(controls.set(CameraControl::Gain, 77.4));
  EXPECT_EQ(get_control(node, V4L2_CID_AUTOGAIN), 0);
  EXPECT_EQ(get_control(node, V4L2_CID_GAIN), 77);
  EXPECT_FALSE(controls.read(CameraControl::Focus));
  EXPECT_FALSE(controls.set(CameraControl::Focus, 1.0));
}

}  // namespace
}  // namespace ar::testing
