#include "app/tables/detection_table.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <nlohmann/json.hpp>

namespace app {
namespace {

std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  std::string out = "\"";
  for (char c : field) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

}  // namespace

// A map of this one tag, its frame the world: the camera's pose in it, turned round.
std::optional<TagPose> tag_pose(const ar::CameraModel& camera, const ar::Detection& detection, double size_m) {
  ar::TagMap map;
  map.family = detection.family;
  map.tags[detection.id] = {ar::Rigid3{}, size_m};
  const auto estimate = ar::estimate_pose(camera, map, {detection});
  if (!estimate) return std::nullopt;
  return TagPose{estimate->world_from_camera.inverse(), estimate->rms_px, estimate->second_best_rms_px};
}

void DetectionTable::add(const std::string& file, const ar::Frame& frame, const ar::Detection& detection,
                         const std::optional<TagPose>& pose) {
  rows_.push_back({file, frame.index, frame.time_s, detection, pose});
}

void DetectionTable::write_csv(std::ostream& out) const {
  out << "file,frame,time_s,family,id,hamming,margin,c0x_px,c0y_px,c1x_px,c1y_px,c2x_px,c2y_px,c3x_px,c3y_px";
  if (with_poses_) out << ",x_m,y_m,z_m,qw,qx,qy,qz,rms_px,second_rms_px";
  out << '\n';
  for (const Row& row : rows_) {
    const ar::Detection& d = row.detection;
    fmt::print(out, "{},{},{:.6f},{},{},{},{:.1f}", quoted(row.file), row.frame, row.time_s, d.family, d.id, d.hamming,
               d.margin);
    for (const cv::Point2d& c : d.corners_px) fmt::print(out, ",{:.4f},{:.4f}", c.x, c.y);
    if (with_poses_ && !row.pose) out << ",,,,,,,,,";
    if (with_poses_ && row.pose) {
      const cv::Vec3d& t = row.pose->camera_from_tag.translation;
      const cv::Vec4d q = ar::quaternion_wxyz(row.pose->camera_from_tag.rotation);
      fmt::print(out, ",{:.6f},{:.6f},{:.6f},{:.8f},{:.8f},{:.8f},{:.8f},{:.4f},", t[0], t[1], t[2], q[0], q[1], q[2],
                 q[3], row.pose->rms_px);
      if (row.pose->second_rms_px) fmt::print(out, "{:.4f}", *row.pose->second_rms_px);
    }
    out << '\n';
  }
}

void DetectionTable::write_json(std::ostream& out) const {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Row& row : rows_) {
    const ar::Detection& d = row.detection;
    nlohmann::ordered_json item{{"file", row.file},   {"frame", row.frame}, {"time_s", row.time_s},
                                {"family", d.family}, {"id", d.id},         {"hamming", d.hamming},
                                {"margin", d.margin}};
    for (const cv::Point2d& c : d.corners_px) item["corners_px"].push_back({c.x, c.y});
    item["center_px"] = {d.center_px.x, d.center_px.y};
    if (row.pose) {
      const cv::Vec3d& t = row.pose->camera_from_tag.translation;
      const cv::Vec4d q = ar::quaternion_wxyz(row.pose->camera_from_tag.rotation);
      item["camera_from_tag"] = {{"position_m", {t[0], t[1], t[2]}},
                                 {"quaternion_wxyz", {q[0], q[1], q[2], q[3]}},
                                 {"rms_px", row.pose->rms_px},
                                 {"second_rms_px", nullptr}};
      if (row.pose->second_rms_px) item["camera_from_tag"]["second_rms_px"] = *row.pose->second_rms_px;
    }
    list.push_back(item);
  }
  // A file's name need not be UTF-8; what is not is replaced.
  out << list.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
}

}  // namespace app
