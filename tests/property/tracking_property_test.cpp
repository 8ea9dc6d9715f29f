// Accuracy of poses on corners with known truth, and what must hold at the extremes.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ar/track/tracker.h"
#include "tests/testing/virtual_walk.h"

namespace ar {
namespace {

using testing::looking_at;
using testing::seen_from;
using testing::world_from_camera_on_walk;

constexpr double kDeg = std::numbers::pi / 180.0;
constexpr double kDistance = 2.0;
constexpr double kNoisePx = 0.1;  // the detector's own, with refined edges

CameraModel hd_camera() {
  return camera_from_horizontal_fov(1280, 720, 1.1);
}

// Size of a tag at kDistance that takes that share of the picture's width.
double size_for(double share) {
  return share * 1280.0 / hd_camera().intrinsics(0, 0) * kDistance;
}

TagMap map_of(int count, double size) {
  TagMap map;
  map.tags[0] = {flat_tag({0.0, 0.0, 0.0}, 0.0), size};
  if (count > 1) map.tags[1] = {flat_tag({2.0 * size, 0.3 * size, 0.0}, 0.3), size};
  if (count > 2) map.tags[2] = {wall_tag({0.0, 1.5 * size, size}, std::numbers::pi), size};
  return map;
}

struct Errors {
  double position = 0.0;  // RMS, share of the distance
  double turn_rad = 0.0;  // RMS
  int frames = 0;
};

Errors errors_of(const TagMap& map, bool smooth, double restless) {
  Errors sum;
  for (int variant = 0; variant < 5; ++variant) {
    std::mt19937 random(11);
    TrackerOptions options;
    options.smooth = smooth;
    Tracker tracker(hd_camera(), map, options);
    for (int i = 0; i < 60; ++i) {
      const double time_s = i / 30.0;
      const Rigid3 truth = world_from_camera_on_walk(time_s, kDistance, variant, restless);
      const Track track = tracker.track(seen_from(hd_camera(), map, truth, kNoisePx, random), time_s);
      if (track.state != TrackState::Tracking || i < 10) continue;
      const double off = cv::norm(track.world_from_camera.translation - truth.translation) / kDistance;
      const double turn = angle_between(track.world_from_camera.rotation, truth.rotation);
      sum.position += off * off;
      sum.turn_rad += turn * turn;
      ++sum.frames;
    }
  }
  return {std::sqrt(sum.position / sum.frames), std::sqrt(sum.turn_rad / sum.frames), sum.frames};
}

TEST(PoseAccuracy, HoldsHalfAPercentAndThreeTenthsOfADegreeRawAndSmoothed) {
  for (int count : {1, 3}) {
    for (double share : {0.05, 0.1, 0.2}) {
      for (bool smooth : {false, true}) {
        const Errors e = errors_of(map_of(count, size_for(share)), smooth, 1.0);
        EXPECT_GT(e.frames, 100);
        EXPECT_LT(e.position, 0.005) << count << " tags of " << share << (smooth ? ", smoothed" : ", raw");
        EXPECT_LT(e.turn_rad, 0.3 * kDeg) << count << " tags of " << share << (smooth ? ", smoothed" : ", raw");
      }
    }
  }
}

TEST(PoseAccuracy, SmoothingHelpsAHandAndATripodMore) {
  const TagMap map = map_of(1, size_for(0.05));
  const Errors raw = errors_of(map, false, 1.0);
  const Errors hand = errors_of(map, true, 1.0);
  const Errors tripod = errors_of(map, true, 0.0);
  EXPECT_LT(hand.position, 0.9 * raw.position);
  EXPECT_LT(hand.turn_rad, 0.9 * raw.turn_rad);
  EXPECT_LT(tripod.position, 0.65 * raw.position);
}

TEST(PoseAccuracy, SmoothingAddsAtMostATenthOfAPixel) {
  std::mt19937 random(5);
  std::mt19937 same(5);
  const TagMap map = map_of(1, size_for(0.1));
  TrackerOptions options;
  Tracker smooth(hd_camera(), map, options);
  options.smooth = false;
  Tracker raw(hd_camera(), map, options);
  for (int i = 0; i < 90; ++i) {
    const double time_s = i / 30.0;
    // Stops dead and starts again each second: the worst for a filter that expects a steady motion.
    const double walked = std::floor(time_s) + std::max(0.0, time_s - std::floor(time_s) - 0.5) * 2.0;
    const Rigid3 truth = world_from_camera_on_walk(walked, kDistance, 2, 2.0);
    const Track a = smooth.track(seen_from(hd_camera(), map, truth, kNoisePx, random), time_s);
    const Track b = raw.track(seen_from(hd_camera(), map, truth, kNoisePx, same), time_s);
    ASSERT_EQ(a.state, TrackState::Tracking) << i;
    EXPECT_LE(a.rms_px, b.rms_px + 0.1 + 1e-6) << i;
  }
}

// Predicted uncertainty against what many trials do: the mean of the squared normalised error of six numbers is 6.
TEST(PoseAccuracy, CovarianceTellsTheErrors) {
  std::mt19937 random(9);
  const TagMap map = map_of(3, size_for(0.1));
  const Rigid3 truth = world_from_camera_on_walk(0.0, kDistance, 3);
  constexpr int kTrials = 300;
  double sum = 0.0;
  for (int i = 0; i < kTrials; ++i) {
    const auto estimate = estimate_pose(hd_camera(), map, seen_from(hd_camera(), map, truth, kNoisePx, random), truth);
    ASSERT_TRUE(estimate);
    const cv::Vec6d off = step_between(truth, estimate->world_from_camera);
    sum += off.dot(estimate->covariance.inv() * off);
  }
  // The noise is estimated from 18 degrees of freedom a trial, which alone spreads the mean by some ten percent.
  EXPECT_NEAR(sum / kTrials, 6.0, 1.2);
}

TEST(EstimatePose, KeepsToTheOthersWhenOneTagIsWrong) {
  std::mt19937 random(2);
  TagMap map = map_of(3, size_for(0.1));
  const Rigid3 truth = world_from_camera_on_walk(0.0, kDistance, 2);
  const auto seen = seen_from(hd_camera(), map, truth, kNoisePx, random);
  ASSERT_EQ(seen.size(), 3u);
  map.tags[1].world_from_tag.translation += cv::Vec3d(0.05, 0.1, 0.0);  // someone moved it
  const auto estimate = estimate_pose(hd_camera(), map, seen);
  ASSERT_TRUE(estimate);
  EXPECT_EQ(estimate->tag_ids, (std::vector<int>{0, 2}));
  EXPECT_LT(cv::norm(estimate->world_from_camera.translation - truth.translation), 0.01 * kDistance);
}

TEST(EstimatePose, AFarSquaresOtherPoseIsToldAndTheNearOneWins) {
  const TagMap map = map_of(1, 0.05);
  const CameraModel camera = hd_camera();
  std::mt19937 random(4);
  int flips_without = 0;
  int flips_with = 0;
  int ambiguous = 0;
  for (int i = 0; i < 60; ++i) {
    const Rigid3 truth = looking_at({0.4, -0.9, 3.5}, {0.0, 0.0, 0.0});
    const auto seen = seen_from(camera, map, truth, 0.2, random);
    const auto alone = estimate_pose(camera, map, seen);
    const auto near = estimate_pose(camera, map, seen, truth);
    ASSERT_TRUE(alone && near);
    const auto flipped = [&](const PoseEstimate& e) {
      return angle_between(e.world_from_camera.rotation, truth.rotation) > 0.25;
    };
    flips_without += flipped(*alone) ? 1 : 0;
    flips_with += flipped(*near) ? 1 : 0;
    ambiguous += alone->second_best_rms_px ? 1 : 0;
  }
  EXPECT_GT(flips_without, 3) << "no ambiguity here: the test shows nothing";
  EXPECT_LE(flips_with, flips_without / 3);
  EXPECT_GT(ambiguous, 20);
}

TEST(EstimatePose, AThousandTagsInOnePicture) {
  TagMap map;
  for (int i = 0; i < 1000; ++i) {
    const int column = i % 40;
    const int row = i / 40;
    map.tags[i] = {flat_tag({0.1 * column - 2.0, 0.1 * row - 1.2, 0.0}, 0.0), 0.07};
  }
  std::mt19937 random(8);
  const Rigid3 truth = looking_at({0.1, -1.5, 4.0}, {0.0, 0.0, 0.0});
  const auto seen = seen_from(hd_camera(), map, truth, kNoisePx, random);
  ASSERT_GT(seen.size(), 500u);
  const auto estimate = estimate_pose(hd_camera(), map, seen);
  ASSERT_TRUE(estimate);
  EXPECT_LT(cv::norm(estimate->world_from_camera.translation - truth.translation), 0.001 * kDistance);
}

bool all_finite(const PoseEstimate& e) {
  double sum = e.rms_px + e.second_best_rms_px.value_or(0.0) + cv::norm(e.world_from_camera.translation);
  for (double v : e.world_from_camera.rotation.val) sum += v;
  for (double v : e.covariance.val) sum += v;
  return std::isfinite(sum);
}

// Corners of any kind, through lenses from none to such as fold within the picture: a finite pose or none.
TEST(EstimatePose, NeverAnythingThatIsNotFinite) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> x(-200.0, 1480.0);
  std::uniform_real_distribution<double> y(-200.0, 920.0);
  std::uniform_real_distribution<double> small(-1e-3, 1e-3);
  std::vector<CameraModel> cameras(3, hd_camera());
  cameras[1].lens = LensModel::PlumbBob;
  cameras[1].distortion = {-2.5, 0.0, 0.05, 0.05};
  cameras[2].lens = LensModel::Fisheye;
  cameras[2].distortion = {0.5, -0.9, 0.3, 0.0};
  const TagMap map = map_of(3, 0.2);
  for (const CameraModel& camera : cameras) {
    for (int trial = 0; trial < 400; ++trial) {
      std::vector<Detection> seen;
      for (int id : {0, 1, 2, 0}) {
        Detection d;
        d.family = "tag36h11";
        d.id = id;
        const cv::Point2d at(x(random), y(random));
        for (cv::Point2d& c : d.corners_px) c = trial % 2 ? cv::Point2d(x(random), y(random)) : at;
        if (trial % 4 == 0) d.corners_px[1] += cv::Point2d(small(random), small(random));
        if (trial % 7 == 0) d.corners_px[2].x = std::nan("");
        seen.push_back(d);
      }
      const auto estimate = estimate_pose(camera, map, seen);
      EXPECT_TRUE(!estimate || all_finite(*estimate)) << trial;
    }
  }
}

TEST(EstimatePose, TagsEdgeOnGiveAFinitePose) {
  std::mt19937 random(6);
  const TagMap map = map_of(1, 0.3);
  for (double elevation_deg : {5.0, 2.0, 1.0, 0.5, 0.1}) {
    const double e = elevation_deg * kDeg;
    const Rigid3 truth = looking_at({0.0, -1.5 * std::cos(e), 1.5 * std::sin(e)}, {0.0, 0.0, 0.0});
    const auto estimate = estimate_pose(hd_camera(), map, seen_from(hd_camera(), map, truth, 0.0, random));
    EXPECT_TRUE(!estimate || all_finite(*estimate)) << elevation_deg;
    if (elevation_deg >= 2.0) {
      ASSERT_TRUE(estimate) << elevation_deg;
      EXPECT_LT(cv::norm(estimate->world_from_camera.translation - truth.translation), 1e-3);
    }
  }
}

TEST(Tracker, IsPredictedForAWhileAndThenLost) {
  std::mt19937 random(6);
  const TagMap map = map_of(1, 0.3);
  Tracker tracker(hd_camera(), map);
  EXPECT_EQ(tracker.track(std::vector<Detection>{}, 0.0).state, TrackState::Lost);
  Rigid3 truth;
  for (int i = 1; i < 30; ++i) {
    truth = looking_at({0.5 * i / 30.0, -1.2, 1.0}, {0.0, 0.0, 0.0});
    EXPECT_EQ(tracker.track(seen_from(hd_camera(), map, truth, 0.05, random), i / 30.0).state, TrackState::Tracking);
  }
  const Track carried = tracker.track(std::vector<Detection>{}, 31.0 / 30.0);
  EXPECT_EQ(carried.state, TrackState::Predicted);
  const Rigid3 there = looking_at({0.5 * 31.0 / 30.0, -1.2, 1.0}, {0.0, 0.0, 0.0});
  EXPECT_LT(cv::norm(carried.world_from_camera.translation - there.translation), 0.01) << "the motion goes on";
  EXPECT_GT(carried.covariance(3, 3), 0.0);
  EXPECT_EQ(tracker.track(std::vector<Detection>{}, 1.5).state, TrackState::Lost);
  EXPECT_EQ(tracker.track(seen_from(hd_camera(), map, truth, 0.05, random), 1.6).state, TrackState::Tracking);
}

TEST(Tracker, FollowsACutAtOnce) {
  std::mt19937 random(6);
  const TagMap map = map_of(3, 0.3);
  Tracker tracker(hd_camera(), map);
  for (int i = 0; i < 40; ++i) {
    const Rigid3 truth = world_from_camera_on_walk(i / 30.0, kDistance, i < 20 ? 1 : 4);
    const Track track = tracker.track(seen_from(hd_camera(), map, truth, kNoisePx, random), i / 30.0);
    ASSERT_EQ(track.state, TrackState::Tracking);
    EXPECT_LT(cv::norm(track.world_from_camera.translation - truth.translation), 0.02 * kDistance) << i;
  }
}

TEST(Tracker, AFlippedPictureDoesNotTurnTheWorldOver) {
  const TagMap map = map_of(1, 0.05);
  std::mt19937 random(4);
  Tracker tracker(hd_camera(), map);
  int flips = 0;
  for (int i = 0; i < 90; ++i) {
    const double t = i / 30.0;
    // Begins close, where there is no doubt, and backs away to where there is.
    const double away = std::min(1.0, 0.35 + 0.4 * t);
    const Rigid3 truth = looking_at(away * cv::Vec3d(0.4, -0.9, 3.5), {0.0, 0.0, 0.0});
    const Track track = tracker.track(seen_from(hd_camera(), map, truth, 0.2, random), t);
    flips += angle_between(track.world_from_camera.rotation, truth.rotation) > 0.25 ? 1 : 0;
  }
  EXPECT_EQ(flips, 0);
}

TEST(Tracker, TimeThatStandsStillOrRunsBackIsBorne) {
  std::mt19937 random(6);
  const TagMap map = map_of(2, 0.3);
  Tracker tracker(hd_camera(), map);
  const Rigid3 truth = world_from_camera_on_walk(0.0, kDistance, 1);
  for (double time_s : {0.0, 0.0, 0.0, 5.0, 4.0, 4.0, 1e9, -1e9}) {
    const Track track = tracker.track(seen_from(hd_camera(), map, truth, kNoisePx, random), time_s);
    EXPECT_EQ(track.state, TrackState::Tracking);
    EXPECT_LT(cv::norm(track.world_from_camera.translation - truth.translation), 0.02 * kDistance);
  }
}

}  // namespace
}  // namespace ar
