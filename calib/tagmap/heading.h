#pragma once

#include <opencv2/core.hpp>

#include "ar/track/lens.h"
#include "ar/track/pose.h"

namespace calib {

// How far a map is to be turned about the vertical, clockwise from above, so that its y axis is true north.
struct Heading {
  double turn_rad = 0.0;  // -pi ... pi
  double sigma_rad = 0.0;
};

// A vertical edge's foot and a point of its shadow on level ground, pixels in OpenCV's count.
struct ShadowClicks {
  cv::Point2d base_px;
  cv::Point2d tip_px;
  double sigma_px = 2.0;
  double ground_m = 0.0;  // height of the ground in the map
};

// The shadow points away from the sun. Uncertainty from the clicks and the camera's pose, to first order. Throws
// std::runtime_error when a click does not meet the ground in front of the camera or both meet it at one place.
Heading heading_from_shadow(const ar::Lens& lens, const ar::Rigid3& map_from_camera, const cv::Matx66d& pose_covariance,
                            const ShadowClicks& clicks, double sun_azimuth_rad);

// Whether a tag lies rather than hangs: its normal is within 45 degrees of the vertical.
bool lies_flat(const ar::Rigid3& world_from_tag);
// Clockwise from the y axis: where the top edge of a tag points that lies, where the face looks of one that hangs.
double heading_of_tag(const ar::Rigid3& world_from_tag);
// The same angle within -pi ... pi.
double wrapped(double angle_rad);

}  // namespace calib
