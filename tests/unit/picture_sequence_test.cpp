// Pictures as a stream of frames, written and read.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/testing/made_clip.h"

namespace ar::testing {
namespace {

using ::testing::ElementsAre;

TEST(PictureSequence, WritesNumberedPngsThatReadBackExactly) {
  const TemporaryFolder folder;
  const SourceInfo info = made_source(33, 21, Chroma::C444, 8, kRgb);
  write_clip(folder / "shot_%03d.png", info, {0, 40, 80});
  EXPECT_THAT(folder.names(), ElementsAre("shot_000.png", "shot_001.png", "shot_002.png"));
  OpenOptions options;
  options.image_frame_rate = 29.97;
  const ReadClip clip = read_clip(folder / "shot_%03d.png", options);
  ASSERT_EQ(clip.pictures.size(), 3U);
  EXPECT_EQ(greatest_difference(clip.pictures[2], made_picture(info.format, 2)), 0);
  EXPECT_THAT(clip.pts, ElementsAre(0, 1, 2));
  EXPECT_NEAR(clip.time_s[2], 2 / 29.97, 1e-6);
  EXPECT_EQ(clip.info.format.color.matrix, ColorMatrix::Rgb);
}

TEST(PictureSequence, LimitedRangeVideoFillsTheRangeOfPng) {
  const TemporaryFolder folder;
  const SourceInfo info = made_source(32, 32, Chroma::C444);
  const auto sink = make_file_sink(folder / "still.png", info);
  OutputFrame frame = sink->allocate();
  fill(frame, {Samples::value_type(1024, 235), Samples::value_type(1024, 128), Samples::value_type(1024, 128)});
  sink->write(std::move(frame), 0);
  sink->finish();
  const ReadClip clip = read_clip(folder / "still.png");
  EXPECT_GE(clip.pictures.at(0)[0][500], 254) << "video white must be picture white";
}

TEST(PictureSequence, PalettesGreyAndDeepPicturesAreRead) {
  const TemporaryFolder folder;
  // From raw samples of the same depth: FFmpeg's own conversions of RGB to deeper RGB lose a step or two.
  const auto still = [&folder](const std::string& pixel, const char* raw_format, const char* format, const char* name) {
    {
      std::ofstream raw(folder / "raw", std::ios::binary);
      for (int i = 0; i < 256; ++i) raw << pixel;
    }
    run(fmt::format("ffmpeg -v error -f rawvideo -pix_fmt {} -s 16x16 -i '{}' -pix_fmt {} '{}'", raw_format,
                    (folder / "raw").string(), format, (folder / name).string()));
    return read_clip(folder / name);
  };
  const std::string zero(1, '\0');
  // Planes are G, B, R. The fixed palette's yellow is 252, 252, 0.
  const ReadClip palette = still("\xff\xff" + zero, "rgb24", "pal8", "palette.png");
  EXPECT_EQ(palette.info.format.color.matrix, ColorMatrix::Rgb);
  EXPECT_EQ(palette.pictures.at(0)[0][0], 252);
  EXPECT_EQ(palette.pictures.at(0)[1][0], 0);
  EXPECT_EQ(palette.pictures.at(0)[2][0], 252);
  const ReadClip deep = still("\xff\xff" + zero + "\x40" + zero + zero, "rgb48le", "rgb48be", "deep.png");
  EXPECT_EQ(deep.info.format.bit_depth, 10);
  EXPECT_EQ(deep.pictures.at(0)[0][0], 0x4000 >> 6);
  EXPECT_EQ(deep.pictures.at(0)[1][0], 0);
  EXPECT_EQ(deep.pictures.at(0)[2][0], 1023);
  const ReadClip grey = still("\xff\xff\xff", "rgb24", "gray", "grey.png");
  EXPECT_EQ(grey.info.format.color.range, ColorRange::Full);
  EXPECT_EQ(grey.pictures.at(0)[0][0], 255);
  EXPECT_EQ(grey.pictures.at(0)[1][0], 128);
}

}  // namespace
}  // namespace ar::testing
