// libcamera's cameras: the webcam through its UVC handler, and vimc through the path of media controllers.

#include <libcamera/libcamera.h>
#include <linux/v4l2-controls.h>

#include "ar/capture/devices/camera_list.h"
#include "ar/capture/libcamera/device.h"
#include "tests/lab/lab.h"
#include "tests/lab/webcam.h"

namespace ar::testing {
namespace {

using std::chrono::steady_clock;

// The first camera of libcamera's whose id or name has that in it; empty where there is none.
std::string libcamera_source(const std::string& part) {
  for (const CameraListing& camera : list_cameras()) {
    const bool theirs = camera.source.starts_with("libcamera:");
    if (theirs && (camera.source + camera.name).find(part) != std::string::npos) return camera.source;
  }
  return {};
}

class LibcameraWebcam : public ::testing::Test {
 protected:
  Webcam webcam_{
      unplugged({"libcamera", 30, {numbered_pictures(false, 160, 120, 16), numbered_pictures(true, 320, 240, 16)}})};
  std::string node_ = await_node("uvcvideo");
  std::string source_ = libcamera_source("Lab webcam");
};

TEST_F(LibcameraWebcam, GivesRawAndMjpegPicturesInOrder) {
  ASSERT_NE(source_, "");
  for (const char* format : {"YUYV", "MJPG"}) {
    const auto source = open_live_source(source_, {{}, {}, {}, format});
    EXPECT_EQ(source->info().codec, format);
    int last = number_in(next_frame(*source));
    std::int64_t missed = source->counts().missed;
    double last_s = 0.0;
    for (int i = 0; i < 40; ++i) {
      const Frame frame = next_frame(*source);
      const double now_s = std::chrono::duration<double>(steady_clock::now().time_since_epoch()).count();
      const auto gap = static_cast<int>(source->counts().missed - missed);
      EXPECT_EQ(number_in(frame), (last + 1 + gap) % 16) << format;
      EXPECT_GT(frame.time_s, last_s);
      EXPECT_LT(now_s - frame.time_s, 3.0);
      missed = source->counts().missed;
      last = number_in(frame);
      last_s = frame.time_s;
    }
    EXPECT_EQ(source->counts().damaged, 0);
  }
}

TEST_F(LibcameraWebcam, IsPulledOutAndComesBackUnderItsIdentity) {
  auto source = open_live_source(source_, {});
  const std::string identity = source->identity();
  next_frame(*source);
  webcam_.pull_out();
  const LiveRead end = read_to_end(*source);
  EXPECT_EQ(end.status, LiveStatus::Lost);
  EXPECT_NE(end.reason.find("the camera is gone"), std::string::npos) << end.reason;
  source.reset();
  EXPECT_TRUE(eventually([&] { return refusal(identity).find("knows no camera") != std::string::npos; }))
      << refusal(identity);
  webcam_.plug_in();
  await_node("uvcvideo");
  ASSERT_TRUE(eventually([&] { return refusal(identity).empty(); })) << refusal(identity);
  next_frame(*open_live_source(identity, {}));
}

TEST_F(LibcameraWebcam, ThatHangsIsQuietAndResumesByItself) {
  const auto source = open_live_source(source_, {{}, {}, {}, "YUYV"});
  next_frame(*source);
  webcam_.hang(true);
  EXPECT_TRUE(eventually([&] { return source->read(500ms).status == LiveStatus::Quiet; }));
  webcam_.hang(false);
  next_frame(*source);
}

TEST_F(LibcameraWebcam, TakesExposureAndGain) {
  const auto source = open_live_source(source_, {});
  CameraControls& controls = *source->controls();
  const auto exposure = controls.read(CameraControl::Exposure);
  ASSERT_TRUE(exposure);
  EXPECT_NEAR(exposure->maximum, 0.5, 1e-9);
  EXPECT_TRUE(controls.set(CameraControl::Exposure, 0.02));
  for (int i = 0; i < 10; ++i) next_frame(*source);
  EXPECT_DOUBLE_EQ(controls.read(CameraControl::Exposure)->value, 0.02);
  EXPECT_EQ(get_control(node_, V4L2_CID_EXPOSURE_ABSOLUTE), 200) << "100 us each";
  EXPECT_FALSE(controls.read(CameraControl::Focus));
}

TEST(LibcameraVimc, GivesItsPictures) {
  const std::string specification = libcamera_source("vimc");
  ASSERT_NE(specification, "") << "is the package libcamera-ipa there?";
  const auto source = open_live_source(specification, {320, 240, {}, {}});
  // A scaler of its own makes 320 a multiple of what it likes.
  EXPECT_NEAR(source->info().format.width, 320, 8);
  EXPECT_EQ(source->info().format.color.matrix, ColorMatrix::Rgb);
  double last_s = 0.0;
  for (int i = 0; i < 10; ++i) {
    const Frame frame = next_frame(*source);
    EXPECT_GT(frame.time_s, last_s);
    last_s = frame.time_s;
    // vimc's bars: the first is white, the last black.
    EXPECT_GT(sample(frame, 4, 100).g, 150.0);
    EXPECT_LT(sample(frame, frame.format.width - 4, 100).g, 60.0);
  }
}

TEST(Libcamera, WhatIsNotThereIsRefusedInOneLineWithWhatToDo) {
  const std::string why = refusal("libcamera:no-such-id");
  EXPECT_NE(why.find("libcamera knows no camera no-such-id\n"), std::string::npos) << why;
}

TEST(Libcamera, ExposureGainTemperatureAndLuxAreTakenFromARequest) {
  namespace controls = libcamera::controls;
  libcamera::ControlList metadata(controls::controls);
  EXPECT_FALSE(lc::exposure_of(metadata).exposure_s);
  metadata.set(controls::ExposureTime, 8000);
  metadata.set(controls::AnalogueGain, 2.0F);
  metadata.set(controls::DigitalGain, 1.5F);
  metadata.set(controls::ColourTemperature, 5600);
  metadata.set(controls::Lux, 1234.0F);
  const ExposureInfo exposure = lc::exposure_of(metadata);
  EXPECT_DOUBLE_EQ(exposure.exposure_s.value_or(0), 0.008);
  EXPECT_DOUBLE_EQ(exposure.gain.value_or(0), 3.0);
  EXPECT_DOUBLE_EQ(exposure.color_temperature_k.value_or(0), 5600.0);
  EXPECT_DOUBLE_EQ(exposure.lux.value_or(0), 1234.0);
}

}  // namespace
}  // namespace ar::testing
