#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "ar/track/camera.h"
#include "ar/track/lens.h"
#include "ar/track/pose.h"

namespace calib {

// One tag in one picture, of tags and cameras whose poses are all sought.
struct TagObservation {
  std::size_t camera = 0;
  std::size_t tag = 0;
  std::array<cv::Point2d, 4> px;  // freed of what bent edges do
  bool used = true;
};

// Poses of cameras and tags in one frame, the first tag's, through a known lens.
struct TagBundle {
  ar::CameraModel lens;
  std::vector<double> tag_size_m;
  std::vector<ar::Rigid3> map_from_tag;  // [0] stays
  std::vector<ar::Rigid3> map_from_camera;
  std::vector<TagObservation> observations;
};

// Least squares over all corners, Cauchy's loss of that scale (0: squares). False when it ends in nothing finite.
bool minimise(TagBundle& bundle, double robust_scale_px);

// Root of the mean squared distance of an observation's corners; infinite where they cannot be projected.
double observation_rms_px(const ar::Lens& lens, const TagBundle& bundle, const TagObservation& observation);

// Covariance of each tag's pose, for corners of 1 px noise, in the six numbers of ar::moved() (turn and shift along the
// axes of the map), the cameras' poses left free. Zero for the first tag, infinite where undetermined.
std::vector<cv::Matx66d> tag_covariances(const TagBundle& bundle);

}  // namespace calib
