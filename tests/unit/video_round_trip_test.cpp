// What goes into a video file comes out again: samples, timestamps, colour tags, turn, aspect, sound, when and where.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <tuple>

#include "ar/capture/color/color.h"
#include "ar/error.h"
#include "ar/place/place.h"
#include "tests/testing/made_clip.h"

namespace ar::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<std::int64_t> kUnevenPts{120, 160, 173, 240, 1000, 1033};

VideoSinkOptions options_for(VideoCodec codec) {
  VideoSinkOptions options;
  options.codec = codec;
  options.preset = "ultrafast";
  options.threads = 1;
  return options;
}

std::string probe(const std::filesystem::path& file, const std::string& entries) {
  return run(fmt::format("ffprobe -v error -show_entries {} -of default=nk=0:nw=1 '{}'", entries, file.string()));
}

// ---- samples

using Format = std::tuple<Chroma, int, ColorInfo>;
class Ffv1RoundTrip : public ::testing::TestWithParam<Format> {};

TEST_P(Ffv1RoundTrip, IsBitExact) {
  const auto& [chroma, bit_depth, color] = GetParam();
  const TemporaryFolder folder;
  // Odd sizes, so that halved chroma planes round up.
  const SourceInfo info = made_source(67, 45, chroma, bit_depth, color);
  write_clip(folder / "a.mkv", info, {0, 40, 80}, options_for(VideoCodec::Ffv1));
  const ReadClip clip = read_clip(folder / "a.mkv");
  EXPECT_EQ(clip.info.format, info.format);
  ASSERT_EQ(clip.pictures.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(greatest_difference(clip.pictures[static_cast<std::size_t>(i)], made_picture(info.format, i)), 0);
  }
}

constexpr ColorInfo kFull601{ColorMatrix::Bt601, ColorRange::Full, Transfer::Bt709, Primaries::Bt601_625,
                             ChromaSiting::Left};
constexpr ColorInfo kWide{ColorMatrix::Bt2020, ColorRange::Limited, Transfer::Bt709, Primaries::Bt2020,
                          ChromaSiting::Left};
std::string format_name(const ::testing::TestParamInfo<Format>& format) {
  const auto& [chroma, bit_depth, color] = format.param;
  const char* layout = chroma == Chroma::C420 ? "C420" : chroma == Chroma::C422 ? "C422" : "C444";
  return fmt::format("{}Bit{}Matrix{}", layout, bit_depth, static_cast<int>(color.matrix));
}

INSTANTIATE_TEST_SUITE_P(Formats, Ffv1RoundTrip,
                         ::testing::Values(Format{Chroma::C420, 8, kHd}, Format{Chroma::C422, 8, kHd},
                                           Format{Chroma::C444, 8, kFull601}, Format{Chroma::C420, 10, kWide},
                                           Format{Chroma::C422, 10, kHd}, Format{Chroma::C444, 10, kFull601},
                                           Format{Chroma::C444, 8, kRgb}, Format{Chroma::C444, 10, kRgb}),
                         format_name);

TEST(VideoRoundTrip, LossyCodecsKeepThePictureWithinTheirQuality) {
  const TemporaryFolder folder;
  for (const VideoCodec codec : {VideoCodec::H264, VideoCodec::Hevc}) {
    for (const int bit_depth : {8, 10}) {
      const SourceInfo info = made_source(96, 64, Chroma::C420, bit_depth);
      VideoSinkOptions options = options_for(codec);
      options.crf = 1;
      options.overwrite = true;
      write_clip(folder / "a.mp4", info, {0, 40}, options);
      const ReadClip clip = read_clip(folder / "a.mp4");
      EXPECT_EQ(clip.info.format.bit_depth, bit_depth);
      // Near-lossless quality: a few steps of 255 at the test picture's hard edges.
      const int limit = bit_depth > 8 ? 32 : 8;
      EXPECT_LE(greatest_difference(clip.pictures.at(1), made_picture(info.format, 1)), limit)
          << static_cast<int>(codec) << ' ' << bit_depth;
    }
  }
}

TEST(VideoRoundTrip, ShortHevcClipsKeepTheirTimes) {
  const TemporaryFolder folder;
  VideoSinkOptions options = options_for(VideoCodec::Hevc);
  options.overwrite = true;
  for (std::size_t frames = 1; frames <= kUnevenPts.size(); ++frames) {
    const std::vector<std::int64_t> pts(kUnevenPts.begin(), kUnevenPts.begin() + static_cast<std::ptrdiff_t>(frames));
    for (const int bit_depth : {8, 10}) {
      write_clip(folder / "a.mkv", made_source(96, 64, Chroma::C420, bit_depth), pts, options);
      std::vector<std::int64_t> from_zero = pts;
      for (std::int64_t& at : from_zero) at -= pts.front();
      EXPECT_EQ(read_clip(folder / "a.mkv").pts, from_zero);
    }
  }
}

TEST(VideoRoundTrip, UntouchedFramesPassOnBitExact) {
  const TemporaryFolder folder;
  const SourceInfo info = made_source(64, 48, Chroma::C420, 10);
  write_clip(folder / "a.mkv", info, kUnevenPts, options_for(VideoCodec::Ffv1));
  copy_clip(folder / "a.mkv", folder / "b.mkv", options_for(VideoCodec::Ffv1));
  const ReadClip a = read_clip(folder / "a.mkv");
  const ReadClip b = read_clip(folder / "b.mkv");
  EXPECT_EQ(a.pictures, b.pictures);
  EXPECT_EQ(a.pts, b.pts);
}

TEST(VideoRoundTrip, RgbPicturesBecomeBt709InH264) {
  const TemporaryFolder folder;
  const SourceInfo info = made_source(64, 48, Chroma::C444, 8, kRgb);
  write_clip(folder / "a.mp4", info, {0, 40}, options_for(VideoCodec::H264));
  const SourceInfo read = open_source(folder / "a.mp4")->info();
  EXPECT_EQ(read.format.chroma, Chroma::C420);
  EXPECT_EQ(read.format.color.matrix, ColorMatrix::Bt709);
  EXPECT_EQ(read.format.color.range, ColorRange::Limited);
  EXPECT_EQ(read.format.color.transfer, Transfer::Srgb);
}

TEST(VideoRoundTrip, OddSizesKeepTheirSize) {
  const TemporaryFolder folder;
  write_clip(folder / "a.mp4", made_source(67, 45), {0, 40}, options_for(VideoCodec::H264));
  const SourceInfo read = open_source(folder / "a.mp4")->info();
  EXPECT_EQ(read.format.width, 67);
  EXPECT_EQ(read.format.height, 45);
}

using Container = std::tuple<VideoCodec, std::string>;
class Timestamps : public ::testing::TestWithParam<Container> {};

TEST_P(Timestamps, KeepUnevenStepsAndBeginAtZero) {
  const auto& [codec, extension] = GetParam();
  const TemporaryFolder folder;
  const auto file = folder / ("a." + extension);
  write_clip(file, made_source(64, 48), kUnevenPts, options_for(codec));
  const ReadClip clip = read_clip(file);
  ASSERT_EQ(clip.time_s.size(), kUnevenPts.size());
  for (std::size_t i = 0; i < kUnevenPts.size(); ++i) {
    EXPECT_NEAR(clip.time_s[i], static_cast<double>(kUnevenPts[i] - kUnevenPts[0]) * 1e-3, 1e-9) << i;
  }
  // Of a Matroska file of a few reordered pictures ffprobe tells no start.
  if (extension != "mkv") EXPECT_THAT(probe(file, "format=start_time"), HasSubstr("start_time=0.000000"));
}

std::string container_name(const ::testing::TestParamInfo<Container>& container) {
  const auto& [codec, extension] = container.param;
  return fmt::format("Codec{}In{}", static_cast<int>(codec), extension);
}

INSTANTIATE_TEST_SUITE_P(Containers, Timestamps,
                         ::testing::Values(Container{VideoCodec::H264, "mp4"}, Container{VideoCodec::H264, "mkv"},
                                           Container{VideoCodec::H264, "mov"}, Container{VideoCodec::Hevc, "mp4"},
                                           Container{VideoCodec::Hevc, "mkv"}, Container{VideoCodec::Ffv1, "mkv"}),
                         container_name);

TEST(VideoTime, FramesReorderedByTheEncoderKeepTheirTimes) {
  const TemporaryFolder folder;
  VideoSinkOptions options = options_for(VideoCodec::H264);
  options.preset = "medium";  // three frames reordered
  std::vector<std::int64_t> pts;
  for (std::int64_t i = 0; i < 30; ++i) pts.push_back(i * 40 + i % 3);
  write_clip(folder / "a.mp4", made_source(64, 48), pts, options);
  copy_clip(folder / "a.mp4", folder / "b.mp4", options);
  const ReadClip a = read_clip(folder / "a.mp4");
  EXPECT_EQ(a.pts.size(), pts.size());
  EXPECT_EQ(a.pts, read_clip(folder / "b.mp4").pts);
}

TEST(VideoTime, FineAndOddTimeBasesAreKeptInMp4) {
  const TemporaryFolder folder;
  SourceInfo info = made_source(64, 48);
  info.time_base = {1001, 30000};
  info.frame_rate = {30000, 1001};
  write_clip(folder / "a.mp4", info, {0, 1, 2, 5}, options_for(VideoCodec::H264));
  const ReadClip clip = read_clip(folder / "a.mp4");
  EXPECT_NEAR(clip.time_s.at(3), 5 * 1001 / 30000.0, 1e-9);
  EXPECT_NEAR(clip.duration_s.at(0), 1001 / 30000.0, 1e-9);
}

TEST(VideoTime, TimestampsThatDoNotRiseAreRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_clip(folder / "a.mp4", made_source(64, 48), {0, 40, 40}, options_for(VideoCodec::H264)),
               std::invalid_argument);
}

// ---- tags

TEST(VideoTags, ColourTagsSurviveEveryCodec) {
  const ColorInfo cases[] = {
      kHd,
      {ColorMatrix::Bt709, ColorRange::Full, Transfer::Bt709, Primaries::Bt709, ChromaSiting::Left},
      {ColorMatrix::Bt601, ColorRange::Limited, Transfer::Bt709, Primaries::Bt601_525, ChromaSiting::Left},
      kFull601,
      {ColorMatrix::Bt709, ColorRange::Limited, Transfer::Srgb, Primaries::Bt709, ChromaSiting::TopLeft},
  };
  const TemporaryFolder folder;
  for (const ColorInfo& color : cases) {
    for (const auto& [codec, name] : {std::pair{VideoCodec::H264, "a.mp4"},
                                      {VideoCodec::H264, "a.mkv"},
                                      {VideoCodec::Hevc, "a.mp4"},
                                      {VideoCodec::Ffv1, "a.mkv"}}) {
      VideoSinkOptions options = options_for(codec);
      options.overwrite = true;
      write_clip(folder / name, made_source(64, 48, Chroma::C420, 8, color), {0, 40}, options);
      ColorInfo read = open_source(folder / name)->info().format.color;
      if (codec == VideoCodec::Ffv1) read.siting = color.siting;  // its stream has no place for it
      EXPECT_EQ(read, color) << name << ' ' << static_cast<int>(codec) << ": " << describe_guess(read, color);
    }
  }
}

TEST(VideoTags, WhatTheSourceLeavesUntaggedStaysUntagged) {
  const TemporaryFolder folder;
  run(fmt::format("ffmpeg -v error -f lavfi -i testsrc2=s=64x48:d=0.2 -c:v libx264 -pix_fmt yuv420p '{}'",
                  (folder / "a.mp4").string()));
  copy_clip(folder / "a.mp4", folder / "b.mp4", options_for(VideoCodec::H264));
  const char* entries = "stream=color_range,color_space,color_transfer,color_primaries";
  EXPECT_EQ(probe(folder / "a.mp4", entries), probe(folder / "b.mp4", entries));
  EXPECT_THAT(probe(folder / "b.mp4", entries), HasSubstr("color_space=unknown"));
  EXPECT_EQ(open_source(folder / "b.mp4")->info().format.color.matrix, ColorMatrix::Bt601);
}

TEST(VideoTags, SampleAspectSurvives) {
  const TemporaryFolder folder;
  SourceInfo info = made_source(64, 48);
  info.sample_aspect = {16, 11};
  for (const char* name : {"a.mp4", "a.mkv"}) {
    write_clip(folder / name, info, {0, 40}, options_for(VideoCodec::H264));
    const Rational aspect = open_source(folder / name)->info().sample_aspect;
    EXPECT_EQ(aspect.num * 11, aspect.den * 16) << name;
  }
}

TEST(VideoTags, MadeClipsSayWhenAndWhere) {
  const TemporaryFolder folder;
  SourceInfo info = made_source(64, 48);
  info.recorded.time = parse_time("2024-06-21T07:30:00Z");
  info.recorded.latitude_deg = 48.8584;
  info.recorded.longitude_deg = -2.2945;
  info.recorded.height_m = 35.0;
  for (const char* name : {"a.mp4", "a.mkv", "a.mov"}) {
    write_clip(folder / name, info, {0, 40}, options_for(VideoCodec::H264));
    const RecordedAt at = open_source(folder / name)->info().recorded;
    EXPECT_EQ(at.time, info.recorded.time) << name;
    // MP4's own box holds 16 bits of a fraction of a degree, and four decimals come back: 11 m.
    EXPECT_NEAR(at.latitude_deg.value_or(0), 48.8584, 1e-4) << name;
    EXPECT_NEAR(at.longitude_deg.value_or(0), -2.2945, 1e-4) << name;
    EXPECT_NEAR(at.height_m.value_or(0), 35.0, 0.01) << name;
  }
  copy_clip(folder / "a.mp4", folder / "b.mp4", options_for(VideoCodec::H264));
  EXPECT_EQ(open_source(folder / "b.mp4")->info().recorded.time, info.recorded.time);
  EXPECT_NEAR(open_source(folder / "b.mp4")->info().recorded.latitude_deg.value_or(0), 48.8584, 1e-4);
}

// ---- turn

TEST(VideoTurn, RotationIsAppliedOnceAndAspectTurnsWithIt) {
  const TemporaryFolder folder;
  SourceInfo info = made_source(64, 48, Chroma::C444);
  info.sample_aspect = {4, 3};
  write_clip(folder / "flat.mkv", info, {0, 40}, options_for(VideoCodec::H264));
  const Samples flat = read_clip(folder / "flat.mkv").pictures.at(0);
  for (const int turn : {90, 180, 270}) {
    // FFmpeg's old `rotate` tag is stored as a matrix that turns as far the other way.
    const auto turned = folder / fmt::format("turned{}.mov", turn);
    run(fmt::format("ffmpeg -v error -i '{}' -c copy -metadata:s:v:0 rotate={} '{}'", (folder / "flat.mkv").string(),
                    360 - turn, turned.string()));
    const ReadClip clip = read_clip(turned);
    EXPECT_EQ(clip.info.rotation_deg, turn);
    const bool quarter = turn != 180;
    ASSERT_EQ(clip.info.format.width, quarter ? 48 : 64);
    const int width = clip.info.format.width;
    EXPECT_EQ(clip.info.sample_aspect.num * (quarter ? 4 : 3), clip.info.sample_aspect.den * (quarter ? 3 : 4)) << turn;
    // The stored top left corner goes clockwise: to the top right, the bottom right, the bottom left.
    const std::size_t corner = turn == 90    ? static_cast<std::size_t>(width) - 1
                               : turn == 180 ? clip.pictures.at(0)[0].size() - 1
                                             : static_cast<std::size_t>(width) * 63;
    EXPECT_EQ(clip.pictures.at(0)[0][corner], flat[0][0]) << turn;

    copy_clip(turned, folder / "again.mp4", [] {
      VideoSinkOptions options = options_for(VideoCodec::H264);
      options.overwrite = true;
      return options;
    }());
    const SourceInfo again = open_source(folder / "again.mp4")->info();
    EXPECT_EQ(again.rotation_deg, 0) << "turned twice";
    EXPECT_EQ(again.format.width, width);
  }
}

}  // namespace
}  // namespace ar::testing
