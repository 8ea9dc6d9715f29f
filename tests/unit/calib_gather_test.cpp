// Which views are asked for and taken while a person holds a board before a camera.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "ar/track/lens.h"
#include "calib/solve/solver.h"
#include "calib/views/next_view.h"
#include "calib/views/view_collector.h"
#include "tests/testing/board_views.h"

namespace {

using calib::FrameUse;
using calib::HeldView;
using calib::LensChoice;
using calib::Reach;
using calib::Tilt;
using ::testing::HasSubstr;

const calib::Board kBoard = calib::make_chessboard(7, 5, 0.03, 0.03);

calib::Observation observation_of(const std::vector<cv::Point2d>& px) {
  calib::Observation seen;
  seen.px = px;
  seen.edge_width_px = 2.0;
  for (int i = 0; i < static_cast<int>(px.size()); ++i) seen.points.push_back(i);
  return seen;
}

// A person who holds the board still for five frames, a tenth of a second each.
class Person {
 public:
  Person() : collector_(kBoard, 1280, 960, 40) {}
  FrameUse holds(calib::Observation seen, int frames = 5) {
    FrameUse use = FrameUse::NoBoard;
    for (int i = 0; i < frames && use != FrameUse::Taken; ++i) {
      seen.time_s = time_s_ += 0.1;
      use = collector_.add(seen);
    }
    return use;
  }
  const calib::ViewCollector& collector() const { return collector_; }
  void takes_back() { collector_.drop_last(); }

 private:
  calib::ViewCollector collector_;
  double time_s_ = 0.0;
};

TEST(HeldView, IsToldFromThePicture) {
  const ar::CameraModel camera = calib::testing::true_camera(LensChoice::Pinhole);
  calib::NextView planner(kBoard, camera.width, camera.height);
  planner.set_camera(camera);
  int told = 0;
  for (int place = 0; place < 9; ++place) {
    for (Tilt tilt : {Tilt::Facing, Tilt::LeftNearer, Tilt::RightNearer, Tilt::TopNearer, Tilt::BottomNearer}) {
      for (Reach reach : {Reach::Near, Reach::Middle, Reach::Far}) {
        const HeldView view{place % 3, place / 3, tilt, reach};
        const auto px = planner.points_px(view);
        if (!px) continue;
        const auto seen = calib::held_view_of(kBoard, observation_of(*px), camera);
        ASSERT_TRUE(seen.has_value());
        EXPECT_EQ(*seen, view) << calib::words_of(view) << " is told as " << calib::words_of(*seen);
        ++told;
      }
    }
  }
  EXPECT_GT(told, 100);
}

TEST(HeldView, HasItsNearerEdgeLarger) {
  const calib::NextView planner(kBoard, 1280, 960);
  const auto left = planner.points_px({1, 1, Tilt::LeftNearer, Reach::Middle});
  const auto top = planner.points_px({1, 1, Tilt::TopNearer, Reach::Middle});
  ASSERT_TRUE(left && top);
  const auto length = [](const std::vector<cv::Point2d>& px, std::size_t a, std::size_t b) {
    return cv::norm(px[a] - px[b]);
  };
  EXPECT_GT(length(*left, 0, 28), 1.1 * length(*left, 6, 34));
  EXPECT_GT(length(*top, 0, 6), 1.1 * length(*top, 28, 34));
}

TEST(NextView, IsWordedForAPerson) {
  EXPECT_EQ(calib::words_of({0, 0, Tilt::LeftNearer, Reach::Near}),
            "in the upper left corner, tilted about the vertical axis (left edge nearer), near");
}

// What is asked for shrinks the uncertainty more than most of what could be asked for, and more than repeating.
TEST(NextView, TellsMoreThanAnotherLikeTheLast) {
  calib::NextView planner(kBoard, 1280, 960);
  const HeldView first{1, 1, Tilt::Facing, Reach::Middle};
  const calib::Observation seen = observation_of(planner.points_px(first).value());
  planner.set_taken({seen});
  const calib::Grid grid = calib::make_grid(1280, 960, 16);
  const HeldView best = planner.best(grid, std::vector<int>(grid.size(), 1));
  EXPECT_NE(best.tilt, Tilt::Facing) << "a board seen from in front cannot tell the focal length";
  EXPECT_LT(planner.shrinks_to(best).value(), 0.8 * planner.shrinks_to(first).value());
}

TEST(NextView, AsksForThePartOfThePictureThatWasNotSeen) {
  calib::NextView planner(kBoard, 1280, 960);
  const calib::Grid grid = calib::make_grid(1280, 960, 16);
  std::vector<int> corners(grid.size(), 1);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (grid.middle(i).x > 800.0 && grid.middle(i).y > 500.0) corners[i] = 0;
  }
  std::vector<calib::Observation> taken;
  for (int column : {0, 1}) {
    for (Tilt tilt : {Tilt::LeftNearer, Tilt::RightNearer, Tilt::TopNearer, Tilt::BottomNearer}) {
      taken.push_back(observation_of(planner.points_px({column, 0, tilt, Reach::Middle}).value()));
    }
  }
  planner.set_taken(taken);
  const HeldView best = planner.best(grid, corners);
  EXPECT_EQ(best.column, 2) << calib::words_of(best);
  EXPECT_EQ(best.row, 2) << calib::words_of(best);
}

TEST(ViewCollector, TakesAViewWhenItIsStillSharpAndNew) {
  const calib::Observations places =
      calib::testing::see(kBoard, calib::testing::true_camera(LensChoice::Pinhole), {.views = 3, .noise_px = 0.0});
  Person person;
  EXPECT_EQ(person.holds({}, 3), FrameUse::NoBoard);
  EXPECT_EQ(person.holds(places.views[0], 3), FrameUse::Moving) << "two tenths of a second are not yet still";
  EXPECT_EQ(person.holds(places.views[0]), FrameUse::Taken);
  EXPECT_EQ(person.holds(places.views[0]), FrameUse::Known);
  calib::Observation blurred = places.views[1];
  blurred.edge_width_px = 7.0;
  EXPECT_EQ(person.holds(blurred), FrameUse::Blurred);
  for (int frame = 0; frame < 10; ++frame) {  // 100 px/s
    calib::Observation moving = places.views[2];
    for (cv::Point2d& p : moving.px) p.x += 10.0 * frame;
    EXPECT_EQ(person.holds(moving, 1), FrameUse::Moving);
  }
  EXPECT_EQ(person.holds(places.views[1]), FrameUse::Taken);
  EXPECT_EQ(person.collector().taken().size(), 2U);
}

TEST(ViewCollector, DoesNotTakeAgainWhatWasTakenBackBeforeTheBoardMoved) {
  const calib::Observations places =
      calib::testing::see(kBoard, calib::testing::true_camera(LensChoice::Pinhole), {.views = 2, .noise_px = 0.0});
  Person person;
  EXPECT_EQ(person.holds(places.views[0]), FrameUse::Taken);
  person.takes_back();
  EXPECT_EQ(person.holds(places.views[0]), FrameUse::Known);
  EXPECT_EQ(person.holds(places.views[1]), FrameUse::Taken);
  EXPECT_EQ(person.holds(places.views[0]), FrameUse::Taken);
}

// A person who does as told gets a good calibration of a camera that is not the one assumed at first.
TEST(ViewCollector, LeadsToAGoodSet) {
  const ar::CameraModel truth = calib::testing::true_camera(LensChoice::PlumbBob4);
  const ar::Lens lens(truth);
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0.0, 0.1);
  Person person;
  int asked = 0;
  for (; asked < 30 && !person.collector().enough(); ++asked) {
    calib::NextView hands(kBoard, truth.width, truth.height);
    hands.set_camera(truth);
    auto px = hands.points_px(person.collector().next());
    if (!px) px = hands.points_px({1, 1, Tilt::TopNearer, Reach::Middle});
    ASSERT_TRUE(px.has_value());
    for (cv::Point2d& p : *px) p += cv::Point2d(noise(random), noise(random));
    person.holds(observation_of(*px));
  }
  EXPECT_TRUE(person.collector().enough()) << person.collector().taken().size() << " views";
  EXPECT_GE(person.collector().taken().size(), 10U);
  EXPECT_GE(person.collector().coverage().picture, 0.6);
  calib::SolveOptions options;
  options.lens = LensChoice::PlumbBob4;
  const auto solution = calib::solve(kBoard, {truth.width, truth.height, person.collector().taken()}, options);
  ASSERT_TRUE(solution.has_value());
  EXPECT_NEAR(solution->intrinsics[0], truth.intrinsics(0, 0), 2.0);  // 0.2 %; its own sigma is a third of that
  EXPECT_LT(solution->sigma_of(0), 1.0);
}

}  // namespace
