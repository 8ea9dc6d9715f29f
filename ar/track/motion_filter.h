#pragma once

#include <opencv2/core.hpp>

#include "ar/track/pose.h"

namespace ar {

// How restless a hand-held camera is: spectral density of the white acceleration that drives the model below.
struct MotionNoise {
  double turn = 0.6;    // rad^2/s^3
  double shift = 0.15;  // m^2/s^3
};

// Error-state Kalman filter of a camera that keeps its velocity (Sola 2017, "Quaternion kinematics for the error-state
// Kalman filter", sections 5 and 6, with white angular and linear acceleration in place of an IMU). The error is
// (turn, shift, turn rate, velocity), all along the axes of the world, the first six as in moved().
class MotionFilter {
 public:
  explicit MotionFilter(const MotionNoise& noise = {}) : noise_(noise) {}

  // Starts at a pose, with a velocity of zero that is not believed much.
  void reset(const Rigid3& world_from_camera, const cv::Matx66d& covariance);
  // Carries the state on by dt >= 0 seconds.
  void predict(double dt);
  // The pose was found to be this, with this covariance, measurement and prediction taken together.
  void correct(const Rigid3& world_from_camera, const cv::Matx66d& covariance);
  // Learns how restless this camera is from a pose that was measured without the filter, before correct(): surprises
  // that are larger than foreseen raise the noise, smaller ones lower it, so that a camera on a tripod comes to rest.
  void adapt(const Rigid3& measured_world_from_camera, const cv::Matx66d& covariance);
  // Believes the state less: its whole covariance times a factor > 1.
  void inflate(double factor) { covariance_ = factor * covariance_; }

  const Rigid3& world_from_camera() const { return world_from_camera_; }
  cv::Matx66d pose_covariance() const { return covariance_.get_minor<6, 6>(0, 0); }
  cv::Vec3d velocity() const { return velocity_; }

 private:
  using Matx12 = cv::Matx<double, 12, 12>;

  MotionNoise noise_;
  double restlessness_ = 1.0;  // factor on noise_
  Rigid3 world_from_camera_;
  cv::Vec3d turn_rate_;  // rad/s
  cv::Vec3d velocity_;   // m/s
  Matx12 covariance_ = Matx12::zeros();
};

}  // namespace ar
