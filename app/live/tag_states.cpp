#include "app/live/tag_states.h"

#include <cmath>
#include <map>

namespace app {
namespace {

double rms_px(const ar::CameraModel& camera, const ar::MappedTag& tag, const ar::Track& track,
              const ar::Detection& detection) {
  const cv::Matx33d camera_from_world = track.world_from_camera.rotation.t();
  std::vector<cv::Point3d> corners_in_camera;
  for (const cv::Vec3d& corner : ar::corners_in_tag(tag.size_m)) {
    const cv::Vec3d in_world = tag.world_from_tag.rotation * corner + tag.world_from_tag.translation;
    const cv::Vec3d in_camera = camera_from_world * (in_world - track.world_from_camera.translation);
    corners_in_camera.emplace_back(in_camera[0], in_camera[1], in_camera[2]);
  }
  const std::vector<cv::Point2d> expected = ar::project(camera, corners_in_camera);
  double squares = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const cv::Point2d off = expected[i] - detection.corners_px.at(i);
    squares += off.dot(off);
  }
  return std::sqrt(squares / 4.0);
}

}  // namespace

std::vector<TagState> tag_states(const ar::CameraModel& camera, const ar::TagMap& map, const ar::Track& track,
                                 const std::vector<ar::Detection>& detections) {
  std::map<int, TagState> states;
  for (const auto& [id, tag] : map.tags) {
    const cv::Vec3d& at = tag.world_from_tag.translation;
    states[id] = {.id = id, .position_m = {{at[0], at[1], at[2]}}, .seen = false, .rms_px = std::nullopt};
  }
  for (const ar::Detection& detection : detections) {
    TagState& state = states[detection.id];
    state.id = detection.id;
    state.seen = true;
    const auto mapped = map.tags.find(detection.id);
    if (mapped == map.tags.end() || track.state == ar::TrackState::Lost) continue;
    state.rms_px = rms_px(camera, mapped->second, track, detection);
  }
  std::vector<TagState> list;
  for (const auto& [id, state] : states) list.push_back(state);
  return list;
}

}  // namespace app
