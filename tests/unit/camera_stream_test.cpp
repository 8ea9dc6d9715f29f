// A driver's buffers, numbers and colours, as frames see them.

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <limits>
#include <stdexcept>

#include "ar/capture/color/color.h"
#include "ar/capture/live/camera_controls.h"
#include "ar/capture/live/camera_format.h"
#include "ar/capture/live/dropped_frame_log.h"
#include "ar/capture/live/frame_clock.h"

namespace ar {
namespace {

constexpr std::int64_t kSecond_us = 1'000'000;

TEST(CameraFormat, NamesAndCodesAreEachOthersInverse) {
  EXPECT_EQ(fourcc_code("YUYV"), V4L2_PIX_FMT_YUYV);
  EXPECT_EQ(fourcc_name(V4L2_PIX_FMT_MJPEG), "MJPG");
  EXPECT_EQ(fourcc_name(V4L2_PIX_FMT_Y16_BE), "Y16 -BE");
  EXPECT_EQ(fourcc_code("Y16 -BE"), V4L2_PIX_FMT_Y16_BE);
}

TEST(CameraFormat, LayoutsCountEveryPlane) {
  EXPECT_EQ((PictureLayout{AV_PIX_FMT_YUYV422, 640, 480, 1280}.bytes()), 614400U);
  EXPECT_EQ((PictureLayout{AV_PIX_FMT_NV12, 640, 480, 640}.bytes()), 460800U);
  EXPECT_EQ((PictureLayout{AV_PIX_FMT_YUV420P, 640, 480, 704}.bytes()), 506880U);  // padded rows
  EXPECT_EQ((PictureLayout{AV_PIX_FMT_YUV420P, 64, 5, 64}.bytes()), 512U);         // an odd height: 5 + 3 rows
  EXPECT_EQ((PictureLayout{AV_PIX_FMT_GRAY8, 641, 480, 644}.bytes()), 309120U);
}

TEST(CameraFormat, PlanesFollowEachOtherInOneBuffer) {
  AVBufferRef* memory = av_buffer_alloc(704 * 720);
  const ffmpeg::FramePtr planar = picture_on({AV_PIX_FMT_YUV420P, 640, 480, 704}, memory);
  EXPECT_EQ(planar->data[1] - planar->data[0], 704 * 480);
  EXPECT_EQ(planar->data[2] - planar->data[1], 352 * 240);
  EXPECT_EQ(planar->linesize[2], 352);
  const ffmpeg::FramePtr paired = picture_on({AV_PIX_FMT_NV12, 640, 480, 704}, memory);
  EXPECT_EQ(paired->data[1] - paired->data[0], 704 * 480);
  EXPECT_EQ(paired->linesize[1], 704);
  EXPECT_EQ(av_buffer_get_ref_count(memory), 3);
  av_buffer_unref(&memory);
  planar->data[2][352 * 240 - 1] = 7;  // the frames keep the memory
}

ColorInfo colors_of(std::uint32_t colorspace, AVPixelFormat pixels, std::uint32_t quantization = 0) {
  v4l2_pix_format described{};
  described.colorspace = colorspace;
  described.quantization = quantization;
  const ffmpeg::FramePtr picture = ffmpeg::make_frame();
  picture->format = pixels;
  tag_colors(described, *picture);
  return color_from_tags({picture->color_primaries, picture->color_trc, picture->colorspace, picture->color_range, 0});
}

// The defaults of the V4L2 documentation, "Detailed Colorspace Descriptions".
TEST(CameraFormat, ColoursFollowTheDocumentedDefaults) {
  EXPECT_EQ(colors_of(V4L2_COLORSPACE_REC709, AV_PIX_FMT_YUYV422),
            (ColorInfo{ColorMatrix::Bt709, ColorRange::Limited, Transfer::Bt709, Primaries::Bt709}));
  EXPECT_EQ(colors_of(V4L2_COLORSPACE_SRGB, AV_PIX_FMT_NV12),
            (ColorInfo{ColorMatrix::Bt601, ColorRange::Limited, Transfer::Srgb, Primaries::Bt709}));
  EXPECT_EQ(colors_of(V4L2_COLORSPACE_SRGB, AV_PIX_FMT_RGB24),
            (ColorInfo{ColorMatrix::Rgb, ColorRange::Full, Transfer::Srgb, Primaries::Bt709}));
  EXPECT_EQ(colors_of(V4L2_COLORSPACE_SRGB, AV_PIX_FMT_NV12, V4L2_QUANTIZATION_FULL_RANGE).range, ColorRange::Full);
}

TEST(CameraFormat, WhatTheDriverDoesNotKnowStaysUnknown) {
  EXPECT_EQ(colors_of(V4L2_COLORSPACE_DEFAULT, AV_PIX_FMT_YUYV422), ColorInfo{});
}

TEST(FrameClock, PassesTheDriversTimesOn) {
  FrameClock clock;
  EXPECT_EQ(clock.read({0, 5 * kSecond_us}, 5 * kSecond_us + 3000).taken_us, 5 * kSecond_us);
  const auto next = clock.read({1, 5 * kSecond_us + 33333}, 5 * kSecond_us + 40000);
  EXPECT_EQ(next.taken_us, 5 * kSecond_us + 33333);
  EXPECT_EQ(next.missed, 0U);
  EXPECT_FALSE(next.foreign);
}

TEST(FrameClock, CountsGapsThroughTheWrapOfTheSequence) {
  FrameClock clock;
  constexpr std::uint32_t kLast = std::numeric_limits<std::uint32_t>::max();
  EXPECT_EQ(clock.read({kLast - 1, 1}, 1).missed, 0U);
  EXPECT_EQ(clock.read({kLast, 2}, 2).missed, 0U);
  EXPECT_EQ(clock.read({0, 3}, 3).missed, 0U);
  EXPECT_EQ(clock.read({4, 4}, 4).missed, 3U);
  EXPECT_EQ(clock.read({0, 5}, 5).missed, 0U) << "a stream that began anew has no gap";
}

TEST(FrameClock, TimesRiseAndNeverLieInTheFuture) {
  FrameClock clock;
  EXPECT_EQ(clock.read({0, 1000}, 900).taken_us, 900) << "a stamp a little ahead is rounding";
  EXPECT_EQ(clock.read({1, 800}, 1200).taken_us, 901);
  EXPECT_EQ(clock.read({2, 801}, 1300).taken_us, 902);
}

TEST(FrameClock, CarriesTimesOfAnotherClockOver) {
  FrameClock clock;
  const std::int64_t now = 1000 * kSecond_us;
  const std::int64_t elsewhere = 1'700'000'000 * kSecond_us;
  EXPECT_EQ(clock.read({0, elsewhere}, now).taken_us, now);
  const auto next = clock.read({1, elsewhere + 40000}, now + 47000);
  EXPECT_TRUE(next.foreign);
  EXPECT_EQ(next.taken_us, now + 40000) << "its spacing is the driver's, not that of the arrivals";
  const auto wrapped = clock.read({2, 12345}, now + 80000);  // long ago: its clock wrapped
  EXPECT_EQ(wrapped.taken_us, now + 80000);
}

TEST(FrameClock, TakesTheArrivalWhereTheDriverSaysNothing) {
  FrameClock clock;
  EXPECT_EQ(clock.read({0, std::nullopt}, 77).taken_us, 77);
}

TEST(ControlSetting, IsReadAsPeopleWriteIt) {
  using Mode = ControlSetting::Mode;
  EXPECT_EQ(parse_control_setting("exposure=0.008"), (ControlSetting{CameraControl::Exposure, Mode::Value, 0.008}));
  EXPECT_EQ(parse_control_setting("white-balance=auto"), (ControlSetting{CameraControl::WhiteBalance}));
  EXPECT_EQ(parse_control_setting("focus=lock"), (ControlSetting{CameraControl::Focus, Mode::Locked}));
  for (const char* wrong : {"", "gain", "gain=", "gain=much", "gain=1x", "gain=nan", "zoom=2", "=auto"}) {
    EXPECT_THROW(parse_control_setting(wrong), std::invalid_argument) << wrong;
  }
}

TEST(DroppedFrameLog, TellsAtMostOnceASecondAndOfNothingNever) {
  DroppedFrameLog log("camera");
  const std::chrono::steady_clock::time_point start{std::chrono::hours(1)};
  EXPECT_FALSE(log.tell(start));
  log.damaged();
  EXPECT_TRUE(log.tell(start));
  for (int ms = 1; ms < 1000; ++ms) {
    log.missed(2);
    EXPECT_FALSE(log.tell(start + std::chrono::milliseconds(ms)));
  }
  EXPECT_TRUE(log.tell(start + std::chrono::seconds(1)));
  EXPECT_FALSE(log.tell(start + std::chrono::seconds(9)));
  EXPECT_EQ(log.counts().missed, 1998);
  EXPECT_EQ(log.counts().damaged, 1);
}

}  // namespace
}  // namespace ar
