#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "ar/track/camera.h"
#include "ar/track/detector.h"
#include "ar/track/tag_map.h"

namespace ar {

enum class TrackState { Lost, Predicted, Tracking };
const char* to_string(TrackState state);

// What the tracker knows of one frame.
struct Track {
  TrackState state = TrackState::Lost;
  Rigid3 world_from_camera;                       // valid unless Lost
  cv::Matx66d covariance = cv::Matx66d::zeros();  // of (rotation vector rad, position m) in the world
  double rms_px = 0.0;                            // reprojection of all used corners, this frame's pose as given out
  std::vector<int> tag_ids;                       // used in this frame
};

struct TrackerOptions {
  // quad_decimate is what tags are sought with while no pose is known; then as much more, up to 3, as their expected
  // size allows.
  DetectorOptions detector;
  bool smooth = true;
  double predict_for_s = 0.25;  // how long a pose is carried on without a tag before the state is Lost
  // While a pose is known, tags are sought where the map expects them, and in the whole picture when none is there and
  // every so many frames: the bound within which a tag that is not in the map, or not where it says, appears. 1:
  // always.
  int full_search_every = 15;
};

// Camera pose from the tags of a map. Frames in order of time.
class Tracker {
 public:
  Tracker(CameraModel camera, TagMap map, TrackerOptions options = {});
  ~Tracker();
  // Throws cv::Exception when the frame's size is not the camera model's.
  Track track(const Frame& frame);
  // The same with detections that were made elsewhere.
  Track track(std::vector<Detection> detections, double time_s);
  // Detections of the last frame, known tags or not.
  const std::vector<Detection>& detections() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Pose of a camera from known tags in one picture; nothing when no known tag is among them. With one tag both planar
// solutions are tried and the better kept; `near` breaks a tie.
struct PoseEstimate {
  Rigid3 world_from_camera;
  cv::Matx66d covariance;
  double rms_px = 0.0;
  std::optional<double> second_best_rms_px;  // of the other planar solution; nothing where there is none
  std::vector<int> tag_ids;
};
std::optional<PoseEstimate> estimate_pose(const CameraModel& camera, const TagMap& map,
                                          const std::vector<Detection>& detections,
                                          const std::optional<Rigid3>& near_world_from_camera = std::nullopt);

}  // namespace ar
