// The parts of `live`: the newest wins, lost cameras come back, quality follows the time there is.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "app/live/distribution.h"
#include "app/live/feed.h"
#include "app/live/governor.h"
#include "app/live/held_mark.h"
#include "app/live/latest.h"
#include "app/live/recorder.h"
#include "app/live/tag_states.h"
#include "app/pipeline/reservoir.h"
#include "ar/capture/ffmpeg.h"
#include "ar/error.h"
#include "ar/output/frame_pool.h"

namespace {

using app::Distribution;
using app::FeedOptions;
using app::Governor;
using app::Latest;
using app::LiveFeed;
using app::Reservoir;
using namespace std::chrono_literals;

TEST(Latest, HandsOutTheNewestAndTellsOfTheStale) {
  Latest<int> place;
  EXPECT_FALSE(place.put(1));
  EXPECT_TRUE(place.put(2)) << "1 was never taken";
  EXPECT_EQ(place.take(0ms), 2);
  EXPECT_EQ(place.take(0ms), std::nullopt);
  EXPECT_FALSE(place.put(3));
  place.close();
  EXPECT_FALSE(place.over()) << "3 is still inside";
  EXPECT_EQ(place.take(0ms), 3);
  EXPECT_TRUE(place.over());
}

TEST(Distribution, FindsPercentilesToATenthOfAMillisecond) {
  Distribution times;
  for (int i = 1; i <= 1000; ++i) times.add(i * 0.5);
  EXPECT_EQ(times.count(), 1000);
  EXPECT_NEAR(times.percentile_ms(0.5), 250.0, 0.1001);
  EXPECT_NEAR(times.percentile_ms(0.99), 495.0, 0.1001);
  EXPECT_DOUBLE_EQ(times.percentile_ms(1.0), 500.0);
  EXPECT_DOUBLE_EQ(times.largest_ms(), 500.0);
  EXPECT_DOUBLE_EQ(times.mean_ms(), 250.25);
}

TEST(Distribution, HoldsWhatLiesOutsideItsBins) {
  Distribution times;
  EXPECT_DOUBLE_EQ(times.percentile_ms(0.99), 0.0);
  times.add(-3.0);
  times.add(1e6);
  EXPECT_LE(times.percentile_ms(0.5), 0.1);
  EXPECT_DOUBLE_EQ(times.largest_ms(), 1e6);
}

TEST(Reservoir, IsExactOfFewValuesAndFairOfMany) {
  Reservoir values;
  EXPECT_DOUBLE_EQ(values.median(), 0.0);
  for (const double value : {5.0, 1.0, 3.0}) values.add(value);
  EXPECT_DOUBLE_EQ(values.median(), 3.0);
  for (int i = 0; i < 1'000'000; ++i) values.add(i);
  // Ranks of the median of a sample of 1024 spread by 1.6 %: four times that. The first 1024 alone would give 511.
  EXPECT_NEAR(values.median(), 500'000.0, 63'000.0);
}

TEST(TagStates, AreTheWholeMapAndWhatElseWasSeen) {
  ar::CameraModel camera;
  camera.intrinsics = {500.0, 0.0, 319.5, 0.0, 500.0, 239.5, 0.0, 0.0, 1.0};
  ar::Track track;
  track.state = ar::TrackState::Tracking;
  track.world_from_camera = {cv::Matx33d(1, 0, 0, 0, -1, 0, 0, 0, -1), {0.0, 0.0, 2.0}};  // from above
  ar::TagMap map;
  map.tags[4] = {ar::flat_tag({0.0, 0.0, 0.0}, 0.0), 0.2};
  map.tags[9] = {ar::flat_tag({1.0, 2.0, 0.5}, 0.0), 0.2};
  ar::Detection seen;
  seen.id = 4;
  // 0.1 m at 2 m are 25 px; the corners are all off by one pixel to the right.
  seen.corners_px = {cv::Point2d(295.5, 264.5), {345.5, 264.5}, {345.5, 214.5}, {295.5, 214.5}};
  ar::Detection unmapped_id;
  unmapped_id.id = 7;
  const auto states = app::tag_states(camera, map, track, {unmapped_id, seen});
  ASSERT_EQ(states.size(), 3U);
  EXPECT_EQ(states[0].id, 4);
  EXPECT_TRUE(states[0].seen);
  EXPECT_NEAR(states[0].rms_px.value(), 1.0, 1e-9);
  EXPECT_EQ(states[1].id, 7);
  EXPECT_TRUE(states[1].seen);
  EXPECT_FALSE(states[1].position_m || states[1].rms_px);
  EXPECT_EQ(states[2].position_m, (std::array<double, 3>{1.0, 2.0, 0.5}));
  EXPECT_FALSE(states[2].seen || states[2].rms_px);
  track.state = ar::TrackState::Lost;
  EXPECT_FALSE(app::tag_states(camera, map, track, {seen})[0].rms_px);
}

// Milliseconds of a frame at each level.
const std::vector<double> kCosts{240.0, 160.0, 80.0, 40.0, 22.0, 14.0};

TEST(Governor, SettlesOnTheBestLevelThatFitsAndStays) {
  Governor governor(kCosts.size(), 25.0);
  for (int frame = 0; frame < 200; ++frame) governor.add(kCosts.at(governor.level()));
  EXPECT_EQ(governor.level(), 4U);
  const std::size_t changes = governor.changes();
  for (int frame = 0; frame < 10'000; ++frame) governor.add(kCosts.at(governor.level()));
  EXPECT_EQ(governor.level(), 4U);
  EXPECT_EQ(governor.changes(), changes) << "it swings";
}

TEST(Governor, GoesUpAgainWhenTimeIsLeftOver) {
  Governor governor(kCosts.size(), 25.0, 5);
  for (int frame = 0; frame < 2000; ++frame) governor.add(0.1 * kCosts.at(governor.level()));
  EXPECT_EQ(governor.level(), 1U) << "16 ms fit into 25, and leave no room for what costs more";
}

TEST(Governor, OneSlowFrameChangesNothing) {
  Governor governor(kCosts.size(), 25.0, 4);
  for (int frame = 0; frame < 100; ++frame) governor.add(frame == 50 ? 33.0 : 20.0);
  EXPECT_EQ(governor.changes(), 0U);
}

TEST(Governor, WithoutATargetItKeepsFullQuality) {
  Governor governor(kCosts.size(), 0.0);
  for (int frame = 0; frame < 100; ++frame) governor.add(1000.0);
  EXPECT_EQ(governor.level(), 0U);
}

TEST(QualityLadder, BeginsWithWhatIsAskedAndGetsCheaper) {
  render::Quality asked;
  asked.render_scale = 0.8;
  const auto presets = app::quality_presets(asked);
  ASSERT_GE(presets.size(), 3U);
  EXPECT_DOUBLE_EQ(presets.front().render_scale, 0.8);
  EXPECT_TRUE(presets.front().anti_alias);
  for (std::size_t i = 1; i < presets.size(); ++i) EXPECT_LE(presets[i].render_scale, presets[i - 1].render_scale);
  EXPECT_FALSE(presets.back().anti_alias);
}

// A camera that gives `frames` pictures of that width and then goes away.
class FakeCamera : public ar::LiveSource {
 public:
  FakeCamera(int frames, int width = 64) : frames_(frames) {
    info_.name = "fake";
    info_.format.width = width;
    info_.format.height = 48;
  }
  const ar::SourceInfo& info() const override { return info_; }
  std::string identity() const override { return "fake:by-serial"; }
  ar::LiveCounts counts() const override { return {.missed = 1, .damaged = 2}; }
  ar::LiveRead read(std::chrono::milliseconds) override {
    if (given_ == frames_) return {.status = ar::LiveStatus::Lost, .frame = std::nullopt, .reason = "unplugged"};
    ar::Frame frame;
    frame.index = given_++;
    return {.status = ar::LiveStatus::Frame, .frame = std::move(frame), .reason = ""};
  }

 private:
  ar::SourceInfo info_;
  int frames_;
  int given_ = 0;
};

FeedOptions quick(std::optional<double> reconnect_for_s) {
  return {.reconnect_for_s = reconnect_for_s, .first_wait = 1ms, .longest_wait = 4ms};
}

// Waits until the feed has nothing more to give.
void wait_until_over(LiveFeed& feed) {
  for (int i = 0; i < 500 && !feed.over(); ++i) feed.take(10ms);
}

TEST(LiveFeed, FindsALostCameraAgainByItsIdentity) {
  int attempts = 0;
  std::string asked;
  const auto reopen = [&](const std::string& identity) -> std::unique_ptr<ar::LiveSource> {
    asked = identity;
    if (++attempts < 3) throw ar::InputError("not there");
    if (attempts > 3) throw ar::InputError("gone for good");
    return std::make_unique<FakeCamera>(5);
  };
  LiveFeed feed(std::make_unique<FakeCamera>(7), reopen, quick(0.2));
  feed.start();
  wait_until_over(feed);
  EXPECT_EQ(asked, "fake:by-serial");
  const app::FeedCounts counts = feed.counts();
  EXPECT_EQ(counts.captured, 12);
  EXPECT_EQ(counts.losses, 2);
  EXPECT_EQ(counts.reconnections, 1);
  EXPECT_EQ(counts.missed, 2) << "of both times together";
  EXPECT_EQ(counts.damaged, 4);
  EXPECT_TRUE(feed.gave_up());
  EXPECT_EQ(feed.lost(), "gone for good");
}

TEST(LiveFeed, GivesUpAtOnceWhenToldTo) {
  bool asked = false;
  const auto reopen = [&](const std::string&) -> std::unique_ptr<ar::LiveSource> {
    asked = true;
    throw ar::InputError("not there");
  };
  LiveFeed feed(std::make_unique<FakeCamera>(1), reopen, quick(0.0));
  feed.start();
  wait_until_over(feed);
  EXPECT_TRUE(feed.gave_up());
  EXPECT_FALSE(asked);
  EXPECT_EQ(feed.lost(), "unplugged");
}

TEST(LiveFeed, DoesNotTakeACameraThatComesBackWithOtherPictures) {
  const auto reopen = [](const std::string&) { return std::make_unique<FakeCamera>(1, 128); };
  LiveFeed feed(std::make_unique<FakeCamera>(1), reopen, quick(0.05));
  feed.start();
  wait_until_over(feed);
  EXPECT_TRUE(feed.gave_up());
  EXPECT_EQ(feed.counts().reconnections, 0);
}

// Of every packet of a Matroska file, milliseconds, as they are written: a player may have its own idea of equal ones.
std::vector<std::int64_t> written_times_ms(const std::filesystem::path& file) {
  std::vector<std::int64_t> times_ms;
  AVFormatContext* input = nullptr;
  if (avformat_open_input(&input, file.c_str(), nullptr, nullptr) < 0) return times_ms;
  const ar::ffmpeg::PacketPtr packet = ar::ffmpeg::make_packet();
  while (av_read_frame(input, packet.get()) >= 0) {
    times_ms.push_back(packet->pts);
    av_packet_unref(packet.get());
  }
  avformat_close_input(&input);
  return times_ms;
}

TEST(Recorder, KeepsTimesAndPutsAHeldPictureAMillisecondBehindTheLast) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / fmt::format("recorder-{}.mkv", getpid());
  ar::SourceInfo source;
  source.format.width = 64;
  source.format.height = 48;
  source.format.color = {ar::ColorMatrix::Bt709, ar::ColorRange::Limited, ar::Transfer::Bt709, ar::Primaries::Bt709};
  source.frame_rate = {10, 1};
  ar::FramePool pool(source.format);
  app::Recorder recorder(file, source, {.codec = ar::VideoCodec::Ffv1, .overwrite = true});
  for (const double time_s : {100.0, 100.1}) recorder.show({.picture = pool.allocate(), .time_s = time_s});
  // As long as it is held it is shown again and again, and comes into the recording once.
  for (int i = 0; i < 3; ++i) recorder.show({.picture = pool.allocate(), .time_s = 100.1, .held = true});
  recorder.show({.picture = pool.allocate(), .time_s = 103.0});
  recorder.finish();
  EXPECT_EQ(recorder.recorded(), 4);
  EXPECT_EQ(written_times_ms(file), (std::vector<std::int64_t>{0, 100, 101, 3000}));
  std::filesystem::remove(file);
}

TEST(HeldMark, StripesAllEdgesAndLeavesTheMiddle) {
  constexpr int kWidth = 160;
  constexpr int kHeight = 90;
  std::vector<std::uint8_t> luma(kWidth * kHeight, 100);
  ar::OutputFrame frame;
  frame.format.width = kWidth;
  frame.format.height = kHeight;
  frame.format.color.range = ar::ColorRange::Limited;
  frame.plane[0] = luma.data();
  frame.stride_bytes[0] = kWidth;
  app::mark_as_held(frame);
  EXPECT_EQ(luma[0], 16);
  EXPECT_THAT(luma[5], testing::AnyOf(16, 235));
  EXPECT_EQ(luma[(kHeight / 2) * kWidth + kWidth / 2], 100);
  EXPECT_NE(luma[(kHeight / 2) * kWidth + kWidth - 1], 100);
  EXPECT_NE(luma[(kHeight - 1) * kWidth + kWidth / 2], 100);
}

}  // namespace
