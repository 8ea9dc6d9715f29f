#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ar/track/lens.h"
#include "calib/tagmap/tag_mapper.h"

namespace calib {

// Which pictures show which tags of a family, and how the tags stand to each other as pairs of them show it.
class TagObservations {
 public:
  // A tag that a picture shows twice is left out of that picture.
  TagObservations(const ar::CameraModel& camera, const std::string& family, const std::vector<TagPicture>& pictures,
                  const MapperOptions& options);

  // The tags of each picture that shows any.
  const std::vector<std::vector<ar::Detection>>& pictures() const { return pictures_; }
  double size_of(int id) const;
  // A map of tags at those poses.
  ar::TagMap map_of(const std::map<int, ar::Rigid3>& poses) const;
  // The tag asked for, or the one seen most often. Throws std::runtime_error when it, or any tag, is not seen.
  int origin() const;
  // Tags that pictures connect, directly or through others.
  std::vector<std::vector<int>> groups() const;
  // Poses in the frame of the origin's tag, tag after tag, each from the one already placed that shares most pictures
  // with it.
  std::map<int, ar::Rigid3> chained(int origin, const std::vector<int>& group) const;

 private:
  std::vector<std::size_t> shared(int a, int b) const;
  const ar::Detection& detection(std::size_t picture, int id) const;
  std::vector<ar::Rigid3> ways_between(int a, int b, const std::vector<std::size_t>& pictures) const;
  std::optional<ar::Rigid3> pair_pose(int a, int b) const;

  ar::Lens lens_;
  std::string family_;
  MapperOptions options_;
  std::vector<std::vector<ar::Detection>> pictures_;
  std::map<int, std::vector<std::size_t>> pictures_of_;
};

}  // namespace calib
