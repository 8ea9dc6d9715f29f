#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "ar/track/lens.h"
#include "ar/track/tag_map.h"

namespace ar {

// Where the tags of a map will be in the next picture: boxes around their predicted outlines, wide enough for three
// standard deviations of the pose, merged where they overlap, their corners on multiples of 8 px (the detector's
// tiles). Empty when searching the whole picture would cost about the same, or when no tag is expected in it.
std::vector<cv::Rect> search_regions(const Lens& lens, const cv::Size& picture, const TagMap& map,
                                     const Rigid3& world_from_camera, const cv::Matx66d& covariance);

}  // namespace ar
