#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "ar/capture/frame.h"
#include "ar/track/tracker.h"

namespace app {

struct TagPose {
  ar::Rigid3 camera_from_tag;
  double rms_px = 0.0;
  std::optional<double> second_rms_px;  // of the other planar solution; nothing where there is none
};

// The pose of one tag by itself. Nothing when the detection allows none.
std::optional<TagPose> tag_pose(const ar::CameraModel& camera, const ar::Detection& detection, double size_m);

// What `skyshaft detect` prints: one row a detection.
class DetectionTable {
 public:
  explicit DetectionTable(bool with_poses) : with_poses_(with_poses) {}
  void add(const std::string& file, const ar::Frame& frame, const ar::Detection& detection,
           const std::optional<TagPose>& pose);
  // Columns file, frame, time_s, family, id, hamming, margin, c0x_px ... c3y_px and, with poses, x_m, y_m, z_m, qw, qx,
  // qy, qz, rms_px, second_rms_px (empty where a detection has no pose, the last also where it has no
  // second one). File names are quoted as RFC 4180 has it.
  void write_csv(std::ostream& out) const;
  // The same, by name; second_rms_px is null where there is no second pose.
  void write_json(std::ostream& out) const;

 private:
  struct Row {
    std::string file;
    std::int64_t frame;
    double time_s;
    ar::Detection detection;
    std::optional<TagPose> pose;
  };
  bool with_poses_;
  std::vector<Row> rows_;
};

}  // namespace app
