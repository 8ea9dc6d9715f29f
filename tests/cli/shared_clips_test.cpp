// Real recordings, in and out again. SKIPPED where the shared data is absent.

#include <gtest/gtest.h>

#include <filesystem>

#include "ar/capture/file/open_source.h"
#include "ar/place/place.h"
#include "tests/testing/made_clip.h"

namespace ar::testing {
namespace {

std::string shared(const std::string& name) {
  return (std::filesystem::path(SKYSHAFT_SHARED_DATA) / name).string();
}

#define NEEDS(file) \
  if (!std::filesystem::exists(file)) GTEST_SKIP() << (file) << " is not here"

std::vector<std::int64_t> timestamps(const std::string& file) {
  std::vector<std::int64_t> pts;
  const auto source = open_source(file);
  while (const auto frame = source->next()) pts.push_back(frame->pts);
  return pts;
}

VideoSinkOptions quick() {
  VideoSinkOptions options;
  options.preset = "ultrafast";
  options.threads = 2;
  return options;
}

// Mean luma of a part of the picture, given in fractions of its size.
double brightness(const Frame& frame, double left, double top, double right, double bottom) {
  double sum = 0.0;
  int count = 0;
  for (int y = static_cast<int>(top * frame.format.height); y < static_cast<int>(bottom * frame.format.height); ++y) {
    for (int x = static_cast<int>(left * frame.format.width); x < static_cast<int>(right * frame.format.width); ++x) {
      sum += frame.plane[0][y * frame.stride_bytes[0] + x];
      ++count;
    }
  }
  return sum / count;
}

TEST(SharedClips, APhonesUpsideDownVideoComesOutUprightWithAllItsTimestamps) {
  const std::string clip = shared("video_single_tag/rit_tag36h11_id3_640x480.mp4");
  NEEDS(clip);
  const TemporaryFolder folder;
  copy_clip(clip, folder / "out.mp4", quick());
  const std::vector<std::int64_t> before = timestamps(clip);
  EXPECT_EQ(before.size(), 702U);
  EXPECT_EQ(before, timestamps(folder / "out.mp4"));
  const auto in = open_source(clip);
  const auto out = open_source(folder / "out.mp4");
  EXPECT_EQ(in->info().rotation_deg, 180);
  EXPECT_EQ(out->info().rotation_deg, 0);
  EXPECT_EQ(in->info().format, out->info().format);
  EXPECT_EQ(in->info().recorded.time, parse_time("2018-10-23T19:10:20Z"));
  EXPECT_EQ(out->info().recorded.time, in->info().recorded.time);
  // Upright, the tag's dark border is near the top of the first picture and its printed caption on white paper below.
  for (FrameSource* source : {in.get(), out.get()}) {
    const auto frame = source->next();
    EXPECT_LT(brightness(*frame, 0.3, 0.17, 0.7, 0.21) + 60.0, brightness(*frame, 0.3, 0.92, 0.7, 0.99));
  }
}

TEST(SharedClips, FullHighDefinitionAndMotionJpegAreRead) {
  const std::string mp4 = shared("video_wpical/field_tags_3_4_short_1080p.mp4");
  const std::string avi = shared("video_wpical/field_tags_3_4_short_mjpeg_1080p.avi");
  NEEDS(mp4);
  const ReadClip a = read_clip(mp4);
  const ReadClip b = read_clip(avi);
  EXPECT_EQ(a.pts.size(), 3U);
  EXPECT_EQ(b.pts.size(), 3U);
  EXPECT_EQ(a.info.format.width, 1920);
  EXPECT_EQ(a.info.format.color.matrix, ColorMatrix::Bt709);
  EXPECT_EQ(b.info.format.color.range, ColorRange::Full);
  EXPECT_EQ(b.info.codec, "mjpeg");
}

TEST(SharedClips, AFolderOfPhotosIsASequence) {
  const std::string folder = shared("room_mapping/images");
  NEEDS(folder);
  const auto source = open_source(folder);
  EXPECT_EQ(source->info().frame_count, 72);
  EXPECT_EQ(source->info().format.width, 816);
  EXPECT_TRUE(source->next());
  EXPECT_EQ(source->info().format.color.transfer, Transfer::Srgb);
}

}  // namespace
}  // namespace ar::testing
