// Sound and subtitles beside the new video: copied bit for bit, in sync, cut where the video is cut.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "tests/testing/made_clip.h"

namespace ar::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

VideoSinkOptions quick(bool overwrite = false) {
  VideoSinkOptions options;
  options.preset = "ultrafast";
  options.threads = 1;
  options.overwrite = overwrite;
  return options;
}

struct Packet {
  double start_s = 0.0;
  std::string hash;
  bool operator==(const Packet&) const = default;
};

// Start times and contents of the packets of one kind of stream ("a:0", "s:0").
std::vector<Packet> packets(const std::filesystem::path& file, const std::string& stream) {
  std::istringstream lines(
      run(fmt::format("ffprobe -v error -select_streams {} -show_entries packet=pts_time,data_hash -show_data_hash md5 "
                      "-of csv=p=0 '{}'",
                      stream, file.string())));
  std::vector<Packet> found;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t comma = line.find(',');
    // Lines of another beginning tell of side data.
    const bool number = !line.empty() && (line[0] == '-' || (line[0] >= '0' && line[0] <= '9'));
    if (number && comma != std::string::npos) {
      found.push_back({std::stod(line), line.substr(comma + 1, line.find(',', comma + 1) - comma - 1)});
    }
  }
  return found;
}

// "start_time" or "duration" of the whole file, s.
double value(const std::filesystem::path& file, const std::string& entry) {
  return std::stod(run(fmt::format("ffprobe -v error -show_entries format={} -of csv=p=0 '{}'", entry, file.string())));
}

void expect_same(const std::vector<Packet>& a, const std::vector<Packet>& b, double tolerance_s) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].hash, b[i].hash) << i;
    EXPECT_NEAR(a[i].start_s, b[i].start_s, tolerance_s) << i;
  }
}

class VideoSound : public ::testing::Test {
 protected:
  // Two seconds of picture and of AAC sound, whose first packet is the encoder's run-in before time zero, subtitles,
  // and when and where.
  void SetUp() override {
    std::ofstream(folder_ / "s.srt") << "1\n00:00:00,500 --> 00:00:01,200\nSunrise\n\n";
    run(fmt::format(
        "ffmpeg -v error -f lavfi -i testsrc2=s=64x48:d=2:r=25 -f lavfi -i sine=d=2.1 -i '{}' -map 0 -map 1 "
        "-map 2 -c:v libx264 -preset ultrafast -pix_fmt yuv420p -c:a aac -c:s mov_text "
        "-metadata creation_time=2024-06-21T07:30:00Z -metadata location=+48.8584+002.2945/ "
        "-metadata:s:a:0 language=fra '{}'",
        (folder_ / "s.srt").string(), in_.string()));
  }

  TemporaryFolder folder_;
  std::filesystem::path in_ = folder_ / "in.mp4";
};

TEST_F(VideoSound, SoundSubtitlesAndMetadataAreCopiedIntoMp4) {
  copy_clip(in_, folder_ / "out.mp4", quick());
  ASSERT_GT(packets(in_, "a:0").size(), 50U);
  // The last digit that ffprobe prints.
  expect_same(packets(in_, "a:0"), packets(folder_ / "out.mp4", "a:0"), 2e-6);
  EXPECT_EQ(packets(folder_ / "out.mp4", "s:0").size(), packets(in_, "s:0").size());
  EXPECT_EQ(read_clip(in_).pts, read_clip(folder_ / "out.mp4").pts);
  const SourceInfo info = open_source(folder_ / "out.mp4")->info();
  EXPECT_EQ(info.recorded.time, open_source(in_)->info().recorded.time);
  EXPECT_TRUE(info.recorded.time);
  EXPECT_NEAR(info.recorded.latitude_deg.value_or(0), 48.8584, 1e-4);
  EXPECT_THAT(run(fmt::format("ffprobe -v error -show_streams '{}'", (folder_ / "out.mp4").string())),
              HasSubstr("TAG:language=fra"));
}

TEST_F(VideoSound, MatroskaKeepsPictureTimesAndLeavesOutTheRunIn) {
  copy_clip(in_, folder_ / "out.mkv", quick());
  std::vector<Packet> expected = packets(in_, "a:0");
  std::erase_if(expected, [](const Packet& packet) { return packet.start_s < 0.0; });
  expect_same(expected, packets(folder_ / "out.mkv", "a:0"), 0.6e-3);  // Matroska counts in milliseconds
  const ReadClip a = read_clip(in_);
  const ReadClip b = read_clip(folder_ / "out.mkv");
  ASSERT_EQ(a.time_s.size(), b.time_s.size());
  for (std::size_t i = 0; i < a.time_s.size(); ++i) EXPECT_NEAR(a.time_s[i], b.time_s[i], 0.6e-3);
}

TEST_F(VideoSound, IsLeftOutWhenNotWanted) {
  VideoSinkOptions options = quick();
  options.copy_other_streams = false;
  copy_clip(in_, folder_ / "out.mp4", options);
  EXPECT_TRUE(packets(folder_ / "out.mp4", "a:0").empty());
  EXPECT_TRUE(open_source(folder_ / "out.mp4")->info().recorded.time);
}

TEST_F(VideoSound, StreamsThatTheContainerCannotHoldAreLeftOut) {
  run(fmt::format("ffmpeg -v error -i '{}' -map 0 -c:v copy -c:a pcm_s16le -c:s ass '{}'", in_.string(),
                  (folder_ / "in.mkv").string()));
  copy_clip(folder_ / "in.mkv", folder_ / "out.mp4", quick());
  EXPECT_TRUE(packets(folder_ / "out.mp4", "a:0").empty());
  EXPECT_TRUE(packets(folder_ / "out.mp4", "s:0").empty());
  EXPECT_EQ(read_clip(folder_ / "out.mp4").pts.size(), 50U);
}

TEST_F(VideoSound, IsCutWhereThePictureIsCut) {
  const auto source = open_source(in_);
  const auto sink = make_file_sink(folder_ / "out.mp4", source->info(), quick());
  // Frames 15 to 29: from 0.6 s to 1.2 s.
  while (auto frame = source->next()) {
    if (frame->index >= 15 && frame->index < 30) sink->write_untouched(std::move(*frame));
  }
  sink->finish();
  const std::vector<Packet> sound = packets(folder_ / "out.mp4", "a:0");
  ASSERT_FALSE(sound.empty());
  EXPECT_NEAR(sound.front().start_s, 0.0, 0.03);  // an AAC packet is 23 ms
  EXPECT_NEAR(sound.back().start_s, 0.6, 0.03);
  EXPECT_NEAR(read_clip(folder_ / "out.mp4").time_s.front(), 0.0, 1e-6);
  EXPECT_NEAR(value(folder_ / "out.mp4", "duration"), 0.6, 0.05);
}

// A broadcast's clock stands anywhere: the copy begins at 0 all the same, its sound as far from its pictures as before.
TEST_F(VideoSound, AStreamWhoseClockStandsAtTenHoursBeginsAtZero) {
  const auto late = folder_ / "late.ts";
  run(fmt::format(
      "ffmpeg -v error -i '{}' -map 0:v -map 0:a -c copy -bsf:v h264_mp4toannexb -output_ts_offset 36000 '{}'",
      in_.string(), late.string()));
  ASSERT_GT(value(late, "start_time"), 35999.0);
  const double picture_s = read_clip(late).time_s.front();
  const std::vector<Packet> before = packets(late, "a:0");
  for (const char* name : {"out.mp4", "out.mkv", "out.mov"}) {
    copy_clip(late, folder_ / name, quick());
    EXPECT_NEAR(value(folder_ / name, "start_time"), 0.0, 0.03) << name;
    EXPECT_NEAR(value(folder_ / name, "duration"), 2.1, 0.05) << name;
    const std::vector<Packet> sound = packets(folder_ / name, "a:0");
    ASSERT_FALSE(sound.empty());
    EXPECT_NEAR(sound.back().start_s, before.back().start_s - picture_s, 1.1e-3) << name;
  }
}

TEST_F(VideoSound, LastsToItsEndWhenThePictureDoes) {
  copy_clip(in_, folder_ / "out.mp4", quick());
  EXPECT_GT(packets(folder_ / "out.mp4", "a:0").back().start_s, 2.05) << "the sound outlasts the picture by 0.1 s";
}

}  // namespace
}  // namespace ar::testing
