#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <string>

#include "ar/track/camera.h"
#include "ar/track/detector.h"
#include "ar/track/pose.h"

namespace ar::testing {

// Pictures of tags whose corners are known exactly, drawn by casting rays, not by warping: what the library's own
// printing routine draws, blurred by averaging over the pixel.
struct TagPicture {
  std::string family = "tag36h11";
  int id = 0;
  double size_m = 0.2;
  Rigid3 camera_from_tag;
};

// 8-bit grey picture of that camera, `samples` x `samples` rays a pixel, Gaussian noise of that sigma added.
cv::Mat draw_tags(const CameraModel& camera, const std::vector<TagPicture>& tags, double noise_sigma = 0.0,
                  int samples = 4, std::uint64_t seed = 1);

// True pixels of a tag's corners, library's order, OpenCV's count.
std::array<cv::Point2d, 4> true_corners_px(const CameraModel& camera, const TagPicture& tag);

// A frame that lends the picture's memory as 8-bit luma.
Frame frame_of(const cv::Mat& gray8, double time_s);

// camera_from_tag of a tag at that place in the camera's frame, turned by those angles from facing the camera (about
// the camera's x, then y, then the optical axis).
Rigid3 facing_tag(const cv::Vec3d& position_in_camera, double about_x_rad, double about_y_rad,
                  double about_z_rad = 0.0);

}  // namespace ar::testing
