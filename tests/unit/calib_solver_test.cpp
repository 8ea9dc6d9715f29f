// The solver and its judge on boards seen without pictures.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ar/track/lens.h"
#include "calib/boards/board_check.h"
#include "calib/solve/corner_error.h"
#include "calib/solve/cross_validation.h"
#include "calib/solve/solver.h"
#include "calib/verdict/quality_gates.h"
#include "calib/views/view_choice.h"
#include "tests/testing/board_views.h"

namespace {

using calib::LensChoice;
using calib::testing::see;
using calib::testing::true_camera;
using calib::testing::ViewSet;
using ::testing::HasSubstr;

const calib::Board kBoard = calib::make_chessboard(7, 5, 0.03, 0.03);

calib::SolveOptions with_lens(LensChoice lens) {
  calib::SolveOptions options;
  options.lens = lens;
  return options;
}

ViewSet quiet(int views) {
  ViewSet set;
  set.views = views;
  set.noise_px = 0.0;
  return set;
}

class EveryLens : public ::testing::TestWithParam<LensChoice> {};

TEST_P(EveryLens, IsProjectedByTheSolverAsByTheTracker) {
  const ar::CameraModel camera = true_camera(GetParam());
  const ar::Lens lens(camera);
  const std::vector<double> v = calib::intrinsics_of(GetParam(), camera);
  for (double x = -0.6; x <= 0.6; x += 0.15) {
    for (double y = -0.4; y <= 0.4; y += 0.1) {
      const double point[3] = {2.0 * x, 2.0 * y, 2.0};
      double px[2];
      ASSERT_TRUE(calib::project_point(GetParam(), v.data(), point, px));
      const auto expected = lens.project({point[0], point[1], point[2]});
      ASSERT_TRUE(expected.has_value());
      EXPECT_NEAR(px[0], expected->x, 1e-9);
      EXPECT_NEAR(px[1], expected->y, 1e-9);
    }
  }
}

// Central differences of 1e-6: their own error is 1e-12 of the third derivative and 1e-10 px / 1e-6 of rounding.
TEST_P(EveryLens, IsDifferentiatedAsDifferencesShow) {
  const std::vector<double> v = calib::intrinsics_of(GetParam(), true_camera(GetParam()));
  const int n = calib::intrinsics_count(GetParam());
  constexpr double kStep = 1e-6;
  for (const cv::Vec3d& on_board : {cv::Vec3d(0.0, 0.0, 0.0), cv::Vec3d(0.21, -0.13, 0.0), cv::Vec3d(-0.3, 0.2, 0.1)}) {
    for (const double turn : {0.0, 1e-5, 0.7}) {
      std::vector<double> numbers = v;
      numbers.insert(numbers.end(), {0.3 * turn, -turn, 0.5 * turn, 0.0, 0.0, 1.1});
      numbers.insert(numbers.end(), on_board.val, on_board.val + 3);
      const auto error = [&](const std::vector<double>& at, const calib::CornerJacobians& wanted) {
        cv::Vec2d px;
        const double* pose = at.data() + n;
        EXPECT_TRUE(calib::corner_error(GetParam(), {}, at.data(), pose, cv::Vec3d(pose + 6), px.val, wanted));
        return px;
      };
      std::vector<double> by_intrinsics(2 * v.size());
      double by_pose[12];
      double by_point[6];
      error(numbers, {by_intrinsics.data(), by_pose, by_point});
      for (int i = 0; i < n + 9; ++i) {
        std::vector<double> ahead = numbers;
        std::vector<double> behind = numbers;
        ahead[static_cast<std::size_t>(i)] += kStep;
        behind[static_cast<std::size_t>(i)] -= kStep;
        const cv::Vec2d slope = (error(ahead, {}) - error(behind, {})) / (2.0 * kStep);
        for (int row = 0; row < 2; ++row) {
          const double told = i < n       ? by_intrinsics[static_cast<std::size_t>(row * n + i)]
                              : i < n + 6 ? by_pose[row * 6 + i - n]
                                          : by_point[row * 3 + i - n - 6];
          EXPECT_NEAR(told, slope[row], 1e-3) << "number " << i << ", coordinate " << row << ", turn " << turn;
        }
      }
    }
  }
}

TEST_P(EveryLens, IsFoundWithoutStartingValues) {
  const ar::CameraModel truth = true_camera(GetParam());
  const auto solution = calib::solve(kBoard, see(kBoard, truth, quiet(10)), with_lens(GetParam()));
  ASSERT_TRUE(solution.has_value());
  EXPECT_LT(solution->rms_px, 1e-3);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(solution->camera.intrinsics(i, i), truth.intrinsics(i, i), 0.2);
  EXPECT_NEAR(solution->camera.intrinsics(0, 2), truth.intrinsics(0, 2), 0.2);
  EXPECT_NEAR(solution->camera.intrinsics(1, 2), truth.intrinsics(1, 2), 0.2);
}

INSTANTIATE_TEST_SUITE_P(Lenses, EveryLens,
                         ::testing::Values(LensChoice::Pinhole, LensChoice::PlumbBob2, LensChoice::PlumbBob4,
                                           LensChoice::Fisheye4, LensChoice::PlumbBob5, LensChoice::Rational8));

TEST(Solver, LeavesOutCornersThatAreWrong) {
  ViewSet set;
  set.views = 8;
  calib::Observations observations = see(kBoard, true_camera(LensChoice::PlumbBob4), set);
  observations.views[2].px[7] += cv::Point2d(4.0, -3.0);
  observations.views[5].px[0] += cv::Point2d(0.0, 2.0);
  const auto solution = calib::solve(kBoard, observations, with_lens(LensChoice::PlumbBob4));
  ASSERT_TRUE(solution.has_value());
  EXPECT_EQ(solution->points_rejected, 2);
  EXPECT_FALSE(solution->views[2].used[7]);
  EXPECT_FALSE(solution->views[5].used[0]);
  EXPECT_NEAR(solution->sigma_px, set.noise_px, 0.01);  // 5 % of 560 numbers' scatter, twice
}

TEST(Solver, FindsABoardThatIsNotFlat) {
  calib::Board bent = kBoard;
  for (cv::Vec3d& p : bent.points) p[2] = 0.004 * std::sin(20.0 * p[0]);  // up to 4 mm
  ViewSet set;
  const calib::Observations observations = see(bent, true_camera(LensChoice::PlumbBob2), set);
  calib::SolveOptions options = with_lens(LensChoice::PlumbBob2);
  const auto as_flat = calib::solve(kBoard, observations, options);
  options.solve_flatness = true;
  options.board_sigma_m = 0.003;
  const auto solved = calib::solve(kBoard, observations, options);
  ASSERT_TRUE(as_flat && solved);
  EXPECT_GT(as_flat->rms_px, 0.5);
  EXPECT_LT(solved->rms_px, 0.2);  // the noise is 0.14 px a corner
  EXPECT_NEAR(solved->camera.intrinsics(0, 0), 1000.0, 3.0 * solved->sigma_of(0));
}

TEST(Judge, CallsAGoodSetGood) {
  ViewSet set;
  set.views = 20;
  const calib::Observations observations = see(kBoard, true_camera(LensChoice::PlumbBob4), set);
  const auto options = with_lens(LensChoice::PlumbBob4);
  const auto solution = calib::solve(kBoard, observations, options);
  ASSERT_TRUE(solution.has_value());
  const calib::Assessment assessment = calib::assess(kBoard, observations, *solution, options);
  EXPECT_NE(assessment.verdict, calib::Verdict::Rejected) << assessment.sentence(*solution);
  EXPECT_NEAR(assessment.held_out_rms_px, solution->rms_px, 0.03);
}

TEST(Judge, NamesHeadOnViews) {
  ViewSet set;
  set.most_tilt_rad = 0.03;
  const calib::Observations observations = see(kBoard, true_camera(LensChoice::Pinhole), set);
  const auto options = with_lens(LensChoice::Pinhole);
  const auto solution = calib::solve(kBoard, observations, options);
  ASSERT_TRUE(solution.has_value());
  const calib::Assessment assessment = calib::assess(kBoard, observations, *solution, options);
  EXPECT_EQ(assessment.verdict, calib::Verdict::Rejected);
  EXPECT_THAT(assessment.sentence(*solution), HasSubstr("all views are head-on"));
}

TEST(Judge, NamesASingleView) {
  const calib::Observations observations = see(kBoard, true_camera(LensChoice::Pinhole), quiet(1));
  const auto options = with_lens(LensChoice::Pinhole);
  const auto solution = calib::solve(kBoard, observations, options);
  ASSERT_TRUE(solution.has_value());
  const calib::Assessment assessment = calib::assess(kBoard, observations, *solution, options);
  EXPECT_EQ(assessment.verdict, calib::Verdict::Rejected);
  EXPECT_THAT(assessment.sentence(*solution), HasSubstr("one view only"));
}

TEST(LensChoice, IsTheSimplestThatPredicts) {
  ViewSet set;
  set.views = 5;
  const LensChoice truth = LensChoice::PlumbBob2;
  const auto chosen = calib::choose_lens(kBoard, see(kBoard, true_camera(truth), set), {}, nullptr);
  ASSERT_TRUE(chosen.has_value());
  EXPECT_EQ(calib::to_string(*chosen), calib::to_string(truth));
}

TEST(BoardCheck, NamesAGapThatIsWrong) {
  calib::GridSpec grid;
  grid.columns = 4;
  grid.rows = 3;
  grid.size_m = 0.04;
  grid.gap_x_m = grid.gap_y_m = 0.02;
  const calib::Board printed = calib::make_tag_grid(grid);
  grid.gap_x_m = 0.012;
  const calib::Board in_file = calib::make_tag_grid(grid);
  ViewSet set;
  set.views = 4;
  const calib::Observations observations = see(printed, true_camera(LensChoice::Pinhole), set);
  EXPECT_FALSE(calib::wrong_step(printed, observations.views, 0.06).has_value());
  const auto wrong = calib::wrong_step(in_file, observations.views, 0.06);
  ASSERT_TRUE(wrong.has_value());
  EXPECT_NEAR(std::abs(wrong->measured.x), 1.5, 0.02);
  EXPECT_NEAR(std::abs(wrong->expected.x), 1.3, 1e-9);
}

TEST(ViewChoice, LeavesOutMovingBlurredAndRepeatedFrames) {
  ViewSet set = quiet(12);
  const calib::Observations places = see(kBoard, true_camera(LensChoice::Pinhole), set);
  std::vector<calib::Observation> frames;  // each place held still for five frames, then gone in one
  for (const calib::Observation& place : places.views) {
    for (int i = 0; i < 5; ++i) {
      frames.push_back(place);
      frames.back().time_s = 0.1 * static_cast<double>(frames.size());
      frames.back().edge_width_px = i == 4 ? 9.0 : 2.0;
    }
  }
  const auto chosen = calib::choose_views(kBoard, frames, 1280, 960, 40);
  EXPECT_LE(chosen.size(), 12U);
  EXPECT_GE(chosen.size(), 8U);
  for (std::size_t i : chosen) EXPECT_EQ(frames[i].edge_width_px, 2.0) << "frame " << i;
}

}  // namespace
