#include "ar/track/motion_filter.h"

#include <algorithm>
#include <cmath>

#include "render/base/check.h"

namespace ar {
namespace {

template <int Rows, int Cols>
void put(cv::Matx<double, 12, 12>& into, int row, int col, const cv::Matx<double, Rows, Cols>& block) {
  for (int r = 0; r < Rows; ++r) {
    for (int c = 0; c < Cols; ++c) into(row + r, col + c) = block(r, c);
  }
}

}  // namespace

void MotionFilter::reset(const Rigid3& world_from_camera, const cv::Matx66d& covariance) {
  constexpr double kTurnRate2 = 1.0;  // (rad/s)^2: a brisk pan
  constexpr double kVelocity2 = 1.0;  // (m/s)^2: a walk
  world_from_camera_ = world_from_camera;
  turn_rate_ = velocity_ = {0.0, 0.0, 0.0};
  covariance_ = Matx12::zeros();
  put(covariance_, 0, 0, covariance);
  for (int i = 0; i < 3; ++i) {
    covariance_(6 + i, 6 + i) = kTurnRate2;
    covariance_(9 + i, 9 + i) = kVelocity2;
  }
}

void MotionFilter::predict(double dt) {
  CHECK(dt >= 0.0);
  const cv::Matx33d turn = rotation_from_vector(turn_rate_ * dt);
  world_from_camera_.rotation = turn * world_from_camera_.rotation;
  world_from_camera_.translation += velocity_ * dt;

  Matx12 transition = Matx12::eye();
  put(transition, 0, 0, turn);
  for (int i = 0; i < 6; ++i) transition(i, 6 + i) = dt;
  covariance_ = transition * covariance_ * transition.t();
  for (int i = 0; i < 6; ++i) {  // the integral of white acceleration over dt
    const double q = restlessness_ * (i < 3 ? noise_.turn : noise_.shift);
    covariance_(i, i) += q * dt * dt * dt / 3.0;
    covariance_(i, 6 + i) += q * dt * dt / 2.0;
    covariance_(6 + i, i) += q * dt * dt / 2.0;
    covariance_(6 + i, 6 + i) += q * dt;
  }
}

// The innovation's mean square in units of its own covariance is 1 where the noise is right (Bar-Shalom, Li and
// Kirubarajan 2001, section 5.4.2).
void MotionFilter::adapt(const Rigid3& measured, const cv::Matx66d& covariance) {
  bool invertible = false;
  const cv::Matx66d weight = (pose_covariance() + covariance).inv(cv::DECOMP_CHOLESKY, &invertible);
  if (!invertible) return;
  const cv::Vec6d innovation = step_between(world_from_camera_, measured);
  const double mean_square = innovation.dot(weight * innovation) / 6.0;
  constexpr double kRate = 0.2;      // some five frames
  constexpr double kOneFrame = 4.0;  // no single frame says more than that
  restlessness_ *= std::exp(kRate * (std::min(mean_square, kOneFrame) - 1.0));
  restlessness_ = std::clamp(restlessness_, 1e-4, 100.0);
}

// With P the covariance before and pose block A, gain G = P[:, pose] A^-1: the rest of the state follows the pose as
// far as it is correlated with it, P' = P - G (A - A') G^T.
void MotionFilter::correct(const Rigid3& world_from_camera, const cv::Matx66d& covariance) {
  const cv::Matx66d before = pose_covariance();
  const cv::Matx<double, 12, 6> gain = covariance_.get_minor<12, 6>(0, 0) * before.inv(cv::DECOMP_CHOLESKY);
  const auto step = gain * step_between(world_from_camera_, world_from_camera);
  world_from_camera_ = world_from_camera;
  turn_rate_ += cv::Vec3d(step(6), step(7), step(8));
  velocity_ += cv::Vec3d(step(9), step(10), step(11));
  covariance_ = covariance_ - gain * (before - covariance) * gain.t();
  covariance_ = 0.5 * (covariance_ + covariance_.t());
}

}  // namespace ar
