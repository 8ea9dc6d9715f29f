#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "ar/track/detector.h"
#include "ar/track/lens.h"
#include "ar/track/tag_map.h"

namespace ar {

// A tag of the map as one picture shows it.
struct SeenTag {
  int id = 0;
  double size_m = 0.0;
  Rigid3 world_from_tag;
  std::array<cv::Vec3d, 4> corners_in_world;
  std::array<cv::Point2d, 4> measured_px;  // as detected
  std::array<cv::Point2d, 4> corners_px;   // freed of what bent edges do to them, see straighten()
  std::array<cv::Point2d, 4> corners_ideal;
  double area_px2 = 0.0;
};

// The detections that the map knows, with finite ideal coordinates at all four corners, largest first.
std::vector<SeenTag> seen_tags(const Lens& lens, const TagMap& map, const std::vector<Detection>& detections);

// A pose with the information that the corners give about it.
struct PoseFit {
  Rigid3 world_from_camera;
  cv::Matx66d information =
      cv::Matx66d::zeros();      // J^T J of the corners in px, steps as in moved(); divide by their variance
  double sum_squares_px2 = 0.0;  // of the used corners' distances
  double cost = 0.0;             // robust, over all tags, px2
  std::vector<bool> used;        // by tag; the others disagree with the rest

  int used_corners() const;
  double rms_px() const;  // root of the mean squared distance of the used corners
};

// What is believed of the pose before this picture.
struct PosePrior {
  Rigid3 world_from_camera;
  cv::Matx66d information = cv::Matx66d::zeros();  // inverse covariance
  double corner_sigma_px = 0.1;                    // what the corners are weighed with against it
};

// Levenberg-Marquardt from `start` on all corners of all tags through the lens. Tags that disagree with the rest by far
// more than a pixel lose their weight (Cauchy). nullopt when no tag can be projected or nothing finite comes out.
std::optional<PoseFit> fit_pose(const Lens& lens, std::vector<SeenTag>& tags, const Rigid3& start,
                                const std::optional<PosePrior>& prior = std::nullopt);

// All poses that explain the corners as a local minimum does, best first: a square seen from afar has two.
// `near`, where given, is tried as a start too.
std::vector<PoseFit> solve_pose(const Lens& lens, std::vector<SeenTag>& tags, const std::optional<Rigid3>& near);

// Variance of a detected corner's coordinate, px2, from what a fit leaves over; pulled towards (0.1 px)^2, the
// detector's measured accuracy, because one tag alone leaves over two numbers only.
double corner_variance_px2(double sum_squares_px2, int corners);

}  // namespace ar
