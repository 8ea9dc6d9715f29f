// Bad input and failing disks: one clear line, a hint, and never half a file under the final name.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "ar/error.h"
#include "tests/testing/made_clip.h"

namespace ar::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

VideoSinkOptions quick(VideoCodec codec = VideoCodec::H264) {
  VideoSinkOptions options;
  options.codec = codec;
  options.preset = "ultrafast";
  options.threads = 1;
  return options;
}

std::vector<std::int64_t> steady(int frames) {
  std::vector<std::int64_t> pts;
  for (int i = 0; i < frames; ++i) pts.push_back(40 * i);
  return pts;
}

std::string refusal(const std::string& path) {
  try {
    read_clip(path);
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << path << " was taken";
  return {};
}

void expect_clear(const std::string& message, const std::string& name, const std::string& reason) {
  EXPECT_THAT(message, HasSubstr(name));
  EXPECT_THAT(message, HasSubstr(reason));
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << "one line of what, one of what to do: " << message;
}

void cut(const std::filesystem::path& file, double kept) {
  std::filesystem::resize_file(
      file, static_cast<std::uintmax_t>(kept * static_cast<double>(std::filesystem::file_size(file))));
}

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(VideoFaults, MissingEmptyAndForeignFilesAreRefusedByName) {
  const TemporaryFolder folder;
  std::ofstream(folder / "empty.mp4").close();
  std::ofstream(folder / "letter.mp4") << "Dear Sir or Madam,\nthis is not a video.\n";
  std::ofstream(folder / "letter.txt") << std::string(5000, 'a') << "\n";
  std::ofstream(folder / "noise.png") << std::string(5000, '\x17');
  expect_clear(refusal(folder / "none.mp4"), "none.mp4", "no such file");
  expect_clear(refusal(folder / "empty.mp4"), "empty.mp4", "empty");
  expect_clear(refusal(folder / "letter.mp4"), "letter.mp4", "not a video");
  expect_clear(refusal(folder / "letter.txt"), "letter.txt", "no video");
  expect_clear(refusal(folder / "noise.png"), "noise.png", "");
}

TEST(VideoFaults, SoundAloneIsNoVideo) {
  const TemporaryFolder folder;
  run(fmt::format("ffmpeg -v error -f lavfi -i sine=d=0.2 '{}'", (folder / "a.wav").string()));
  expect_clear(refusal(folder / "a.wav"), "a.wav", "no video stream");
}

TEST(VideoFaults, AnMp4WithoutItsIndexIsCalledCutShort) {
  const TemporaryFolder folder;
  write_clip(folder / "a.mp4", made_source(320, 240), steady(50), quick());
  cut(folder / "a.mp4", 0.5);
  expect_clear(refusal(folder / "a.mp4"), "a.mp4", "cut short");
}

TEST(VideoFaults, ATruncatedVideoPlaysUpToTheDamageAndCountsIt) {
  const TemporaryFolder folder;
  write_clip(folder / "a.mkv", made_source(320, 240), steady(50), quick());
  run(fmt::format("ffmpeg -v error -i '{}' -c copy -movflags faststart '{}'", (folder / "a.mkv").string(),
                  (folder / "fast.mp4").string()));
  for (const char* name : {"a.mkv", "fast.mp4"}) {
    cut(folder / name, 0.5);
    const ReadClip clip = read_clip(folder / name);
    EXPECT_GT(clip.pts.size(), 5U) << name;
    EXPECT_LT(clip.pts.size(), 45U) << name;
  }
  EXPECT_GT(read_clip(folder / "fast.mp4").damaged, 0);
}

TEST(VideoFaults, DamageInTheMiddleIsPassedOverAndCounted) {
  const TemporaryFolder folder;
  write_clip(folder / "a.mp4", made_source(320, 240), steady(20), quick());
  {
    // More than a frame's bytes, so that a frame's head is hit.
    const std::uintmax_t size = std::filesystem::file_size(folder / "a.mp4");
    std::fstream file(folder / "a.mp4", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(size / 2));
    file << std::string(size / 8, '\x5a');
  }
  const ReadClip clip = read_clip(folder / "a.mp4");
  EXPECT_GE(clip.pts.size(), 12U);
  EXPECT_GT(clip.damaged, 0);
}

TEST(VideoFaults, PicturesThatCannotBeReadOrDifferInSizeArePassedOver) {
  const TemporaryFolder folder;
  const SourceInfo info = made_source(32, 24, Chroma::C444, 8, kRgb);
  write_clip(folder / "p_%d.png", info, {0, 1, 2, 3});
  std::ofstream(folder / "p_1.png") << "not a picture";
  run(fmt::format("ffmpeg -v error -y -i '{}' -vf scale=40:24 '{}'", (folder / "p_0.png").string(),
                  (folder / "p_2.png").string()));
  const ReadClip clip = read_clip(folder / "p_%d.png");
  EXPECT_THAT(clip.pts, ElementsAre(0, 3));
  EXPECT_EQ(clip.damaged, 2);
}

TEST(VideoFaults, HdrIsRefusedUnlessToneMapped) {
  const TemporaryFolder folder;
  for (const auto& [transfer, name] : {std::pair{Transfer::Pq, "PQ"}, {Transfer::Hlg, "HLG"}}) {
    const ColorInfo hdr{ColorMatrix::Bt2020, ColorRange::Limited, transfer, Primaries::Bt2020, ChromaSiting::Left};
    VideoSinkOptions options = quick(VideoCodec::Hevc);
    options.overwrite = true;
    write_clip(folder / "hdr.mp4", made_source(64, 48, Chroma::C420, 10, hdr), steady(3), options);
    expect_clear(refusal(folder / "hdr.mp4"), "hdr.mp4", name);

    OpenOptions mapped;
    mapped.tone_map_hdr = true;
    const ReadClip clip = read_clip(folder / "hdr.mp4", mapped);
    EXPECT_EQ(clip.info.format.color, kHd);
    EXPECT_FALSE(clip.info.tags) << "the HDR tags must not be written over SDR pictures";
    ASSERT_EQ(clip.pictures.size(), 3U);
    const auto [darkest, brightest] = std::minmax_element(clip.pictures[0][0].begin(), clip.pictures[0][0].end());
    EXPECT_GE(*darkest, 40) << "below 10-bit black";
    EXPECT_GT(*brightest, *darkest + 100) << "the picture must not be flat";
  }
}

TEST(SinkFaults, AnExistingFileIsRefusedBeforeAnythingIsWritten) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.mp4") << "earlier work";
  std::ofstream(folder / "p_3.png") << "earlier work";
  for (const char* name : {"a.mp4", "p_%d.png"}) {
    try {
      make_file_sink(folder / name, made_source(64, 48), quick());
      FAIL() << name << " was taken";
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("--overwrite"));
    }
  }
  EXPECT_EQ(contents(folder / "a.mp4"), "earlier work");
  EXPECT_THAT(folder.names(), ElementsAre("a.mp4", "p_3.png"));
}

TEST(SinkFaults, ImpossibleOutputsAreNamed) {
  const TemporaryFolder folder;
  const SourceInfo info = made_source(64, 48);
  EXPECT_THROW(make_file_sink(folder / "none" / "a.mp4", info), std::runtime_error);
  EXPECT_THROW(make_file_sink(folder / "a.xyz", info), std::runtime_error);
  EXPECT_THROW(make_file_sink(folder / "a.mp4", info, quick(VideoCodec::Ffv1)), std::runtime_error);
  EXPECT_THROW(make_file_sink(folder.path(), info), std::runtime_error);
  VideoSinkOptions odd = quick();
  odd.preset = "very-pretty";
  EXPECT_THROW(make_file_sink(folder / "a.mp4", info, odd), std::runtime_error);
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(SinkFaults, FramesOfAnotherFormatAreRefused) {
  const TemporaryFolder folder;
  const auto sink = make_file_sink(folder / "a.mp4", made_source(64, 48), quick());
  const auto other = make_file_sink(folder / "b.mp4", made_source(64, 40), quick());
  EXPECT_THROW(sink->write(other->allocate(), 0), std::invalid_argument);
  EXPECT_THROW(sink->write(OutputFrame{}, 0), std::invalid_argument);
}

TEST(SinkFaults, WithoutFinishNothingAppearsAndTheEarlierFileStays) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.mp4") << "earlier work";
  for (const char* name : {"a.mp4", "b.mkv", "p_%d.png"}) {
    VideoSinkOptions options = quick();
    options.overwrite = true;
    const auto sink = make_file_sink(folder / name, made_source(64, 48), options);
    OutputFrame frame = sink->allocate();
    fill(frame, made_picture(frame.format, 0));
    sink->write(std::move(frame), 0);
    EXPECT_EQ(contents(folder / "a.mp4"), "earlier work");
  }
  EXPECT_THAT(folder.names(), ElementsAre("a.mp4"));
  EXPECT_EQ(contents(folder / "a.mp4"), "earlier work");
}

TEST(SinkFaults, WhatAppearsMeanwhileIsNotReplacedAndTheFinishedFileIsKept) {
  const TemporaryFolder folder;
  const auto sink = make_file_sink(folder / "a.mp4", made_source(64, 48), quick());
  OutputFrame frame = sink->allocate();
  fill(frame, made_picture(frame.format, 0));
  sink->write(std::move(frame), 0);
  std::ofstream(folder / "a.mp4") << "another's work";
  try {
    sink->finish();
    FAIL() << "it was replaced";
  } catch (const std::runtime_error& error) {
    expect_clear(error.what(), "a.mp4", "appeared meanwhile");
  }
  EXPECT_EQ(contents(folder / "a.mp4"), "another's work");
  ASSERT_EQ(folder.names().size(), 2U);
  EXPECT_EQ(read_clip(folder / folder.names().front()).pts.size(), 1U);
}

TEST(SinkFaults, AKilledWriterLeavesTheEarlierFileAlone) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.mp4") << "earlier work";
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    VideoSinkOptions options = quick(VideoCodec::Ffv1);
    options.overwrite = true;
    const auto sink = make_file_sink(folder / "b.mkv", made_source(64, 48), options);
    const auto again = make_file_sink(folder / "a.mp4", made_source(64, 48), [&options] {
      VideoSinkOptions h264 = options;
      h264.codec = VideoCodec::H264;
      return h264;
    }());
    for (int i = 0; i < 10; ++i) sink->write(sink->allocate(), i);
    for (int i = 0; i < 10; ++i) again->write(again->allocate(), i);
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(contents(folder / "a.mp4"), "earlier work");
  EXPECT_FALSE(std::filesystem::exists(folder / "b.mkv"));
}

// The limit on a file's size stands for a full disk: writes fail in the same way, in the middle.
TEST(SinkFaults, AFullDiskIsNamedAndTheEarlierFileStays) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.mkv") << "earlier work";
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  for (const char* name : {"a.mkv", "shot_%d.png"}) {
    VideoSinkOptions options = quick(VideoCodec::Ffv1);
    options.overwrite = true;
    rlimit small = before;
    small.rlim_cur = 4000;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    std::string message;
    try {
      write_clip(folder / name, made_source(320, 240), steady(30), options);
    } catch (const std::runtime_error& error) {
      message = error.what();
    }
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    EXPECT_THAT(message, HasSubstr(name == std::string("a.mkv") ? "a.mkv" : "shot_0.png"));
    EXPECT_THAT(message, HasSubstr("File too large"));
  }
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(contents(folder / "a.mkv"), "earlier work");
  EXPECT_THAT(folder.names(), ElementsAre("a.mkv"));
}

}  // namespace
}  // namespace ar::testing
