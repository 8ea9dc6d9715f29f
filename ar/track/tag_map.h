#pragma once

#include <array>
#include <map>
#include <string>

#include "ar/track/pose.h"

namespace ar {

// One tag of known place. Size: outer edge of the black border (white for inverted families), metres.
struct MappedTag {
  Rigid3 world_from_tag;
  double size_m = 0.0;
};

struct TagMap {
  std::string family = "tag36h11";
  std::map<int, MappedTag> tags;  // by id
};

// Corners in the tag's frame in the library's order: left-bottom, right-bottom, right-top, left-top.
std::array<cv::Vec3d, 4> corners_in_tag(double size_m);

// A tag that lies face up at `position`, its top edge towards `top_edge_heading_rad` (clockwise from north).
Rigid3 flat_tag(const cv::Vec3d& position_in_world, double top_edge_heading_rad);
// A tag that hangs upright at `position`, the normal of its printed face towards `faces_heading_rad`.
Rigid3 wall_tag(const cv::Vec3d& position_in_world, double faces_heading_rad);

}  // namespace ar
