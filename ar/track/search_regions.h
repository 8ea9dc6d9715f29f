#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "ar/track/lens.h"
#include "ar/track/tag_map.h"

namespace ar {

// Where the tags of a map will be in the next picture.
struct SearchRegions {
  std::vector<cv::Rect> boxes;
  double smallest_side_px = 0.0;  // of the expected tags' outlines
};

// Boxes around the predicted outlines, wide enough for three standard deviations of the pose, merged where they
// overlap, their corners on multiples of 24 px, so that the detector's tiles lie as in the whole picture for decimation
// 1, 2 and
// 3. Empty when searching the whole picture would cost about the same, or when no tag is expected in it.
SearchRegions search_regions(const Lens& lens, const cv::Size& picture, const TagMap& map,
                             const Rigid3& world_from_camera, const cv::Matx66d& covariance);

}  // namespace ar
