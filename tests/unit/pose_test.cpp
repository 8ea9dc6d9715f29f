#include "ar/track/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "ar/track/tag_map.h"

namespace ar {
namespace {

constexpr double kPi = std::numbers::pi;

cv::Matx33d turned(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return rotation_from_quaternion_wxyz({normal(random), normal(random), normal(random), normal(random)});
}

TEST(Quaternion, RoundTripsAtEveryAngleHalfTurnsIncluded) {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const cv::Matx33d r = turned(random);
    const cv::Vec4d q = quaternion_wxyz(r);
    EXPECT_NEAR(cv::norm(q), 1.0, 1e-12);
    EXPECT_GE(q[0], 0.0);
    EXPECT_LT(cv::norm(rotation_from_quaternion_wxyz(q) - r), 1e-12);
  }
  for (const cv::Vec3d& half : {cv::Vec3d(kPi, 0, 0), cv::Vec3d(0, kPi, 0), cv::Vec3d(0, 0, kPi)}) {
    const cv::Matx33d r = rotation_from_vector(half);
    EXPECT_LT(cv::norm(rotation_from_quaternion_wxyz(quaternion_wxyz(r)) - r), 1e-12);
  }
}

TEST(Quaternion, QuarterTurnAboutZTakesXToY) {
  const double h = std::sqrt(0.5);
  const cv::Vec3d y = rotation_from_quaternion_wxyz({h, 0, 0, h}) * cv::Vec3d(1, 0, 0);
  EXPECT_NEAR(y[1], 1.0, 1e-12);
}

TEST(RotationVector, RoundTripsFromTinyToHalfATurn) {
  for (double angle : {0.0, 1e-12, 1e-7, 1e-3, 1.0, 3.0, kPi - 1e-9}) {
    const cv::Vec3d v = angle * cv::normalize(cv::Vec3d(1.0, -2.0, 0.5));
    EXPECT_LT(cv::norm(vector_from_rotation(rotation_from_vector(v)) - v), 1e-8 * (1.0 + angle)) << angle;
  }
}

TEST(Rigid3, StepsTakeOnePoseToAnother) {
  std::mt19937 random(4);
  const Rigid3 a{turned(random), {1.0, 2.0, 3.0}};
  const Rigid3 b{turned(random), {-1.0, 0.5, 2.0}};
  const Rigid3 there = moved(a, step_between(a, b));
  EXPECT_LT(cv::norm(there.rotation - b.rotation), 1e-12);
  EXPECT_LT(cv::norm(there.translation - b.translation), 1e-12);
}

TEST(TagMap, AFlatTagsTopEdgePointsWhereItsHeadingSays) {
  const Rigid3 tag = flat_tag({1.0, 2.0, 0.0}, 0.5 * kPi);  // towards the east
  const auto corners = corners_in_tag(0.2);
  const cv::Vec3d top = tag * (0.5 * (corners[2] + corners[3]));
  EXPECT_LT(cv::norm(top - cv::Vec3d(1.1, 2.0, 0.0)), 1e-12);
  const cv::Vec3d right = tag * (0.5 * (corners[1] + corners[2]));  // seen from above, east is up and south is right
  EXPECT_LT(cv::norm(right - cv::Vec3d(1.0, 1.9, 0.0)), 1e-12);
  EXPECT_NEAR(cv::determinant(tag.rotation), 1.0, 1e-12);
}

TEST(TagMap, AWallTagsFaceLooksWhereItsHeadingSays) {
  const Rigid3 tag = wall_tag({0.0, 5.0, 1.5}, kPi);  // faces south: seen by one who looks north
  const auto corners = corners_in_tag(0.2);
  EXPECT_LT(cv::norm(tag * (0.5 * (corners[2] + corners[3])) - cv::Vec3d(0.0, 5.0, 1.6)), 1e-12) << "top is up";
  EXPECT_LT(cv::norm(tag * (0.5 * (corners[1] + corners[2])) - cv::Vec3d(0.1, 5.0, 1.5)), 1e-12) << "right is east";
  EXPECT_LT(cv::norm(tag.rotation * cv::Vec3d(0, 0, -1) - cv::Vec3d(0, -1, 0)), 1e-12) << "its face looks south";
}

}  // namespace
}  // namespace ar
