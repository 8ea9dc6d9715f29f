#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ar/track/camera.h"
#include "ar/track/detector.h"
#include "ar/track/tag_map.h"

namespace calib {

// The tags that one picture shows; each id once.
struct TagPicture {
  std::string name;
  std::vector<ar::Detection> detections;
};

struct MapperOptions {
  double tag_size_m = 0.0;            // of all tags but those named
  std::map<int, double> own_sizes_m;  // by id
  std::optional<int> origin;          // the tag whose frame the map has; absent: the one seen most often
};

struct MappedTagNote {
  int pictures = 0;  // that show it and were used
  double sigma_position_m =
      0.0;  // standard deviation of its middle relative to the origin's, root of the sum over the axes
  double sigma_turn_rad = 0.0;
  double rms_px = 0.0;
};

// Tags' poses in the frame of the origin's tag.
struct MapResult {
  ar::TagMap map;
  std::map<int, MappedTagNote> notes;
  int origin = 0;
  std::vector<std::vector<int>> other_groups;  // tags that no picture connects with the origin, group by group
  int pictures_used = 0;
  int corners_used = 0;
  int observations_rejected = 0;
  double rms_px = 0.0;    // root of the mean squared distance of all used corners
  double worst_px = 0.0;  // largest RMS of one tag in one picture
};

// Bundle adjustment of all tags and cameras: starts from pairs of tags seen together (the most often seen first, both
// poses of each square tried), then all at once, tags in pictures that do not fit left out. Throws std::runtime_error:
// no tags, an origin that is not seen, no picture with two tags and more than one tag.
MapResult map_tags(const ar::CameraModel& camera, const std::string& family, const std::vector<TagPicture>& pictures,
                   const MapperOptions& options);

}  // namespace calib
