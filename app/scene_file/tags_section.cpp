// `tags:` and the tag map files that it may name.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "app/scene_file/sections.h"
#include "ar/track/detector.h"

namespace app {
namespace {

// Highest id of a family in libapriltag 3.3.0.
int highest_id(const std::string& family) {
  if (family == "tag36h11") return 586;
  if (family == "tag25h9") return 34;
  if (family == "tag16h5") return 29;
  if (family == "tagCircle21h7") return 37;
  if (family == "tagStandard41h12") return 2114;
  return 48713;  // tagStandard52h13
}

cv::Vec3d to_cv(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

ar::Rigid3 read_orientation(const YamlValue& value, const cv::Vec3d& position) {
  const std::string accepted = "a unit quaternion [w, x, y, z] that takes the tag's frame into the world";
  const auto items = value.list();
  if (items.size() != 4) value.fail(accepted);
  cv::Vec4d wxyz;
  for (int i = 0; i < 4; ++i) {
    wxyz[i] = items[static_cast<std::size_t>(i)].number("a finite number", [](double) { return true; });
  }
  const double length = cv::norm(wxyz);
  // Three decimals a component are enough to be called a unit quaternion; it is normalised after the check.
  if (std::abs(length - 1.0) > 0.005) {
    value.fail_found(fmt::format("a quaternion of length {:.4f}", length), accepted);
  }
  return {ar::rotation_from_quaternion_wxyz(wxyz / length), position};
}

ar::Rigid3 read_world_from_tag(const YamlMap& map) {
  const cv::Vec3d position = to_cv(read_position(map.require("position", "[east, north, up] in metres")));
  const std::string way = map.exactly_one_of({"flat", "wall", "orientation"});
  const YamlValue value = *map.find(way);
  if (way == "orientation") return read_orientation(value, position);
  const std::string angle = way == "flat" ? "top_edge_heading_deg" : "faces_heading_deg";
  const double heading_rad =
      read_heading_rad(value.map({angle}).require(angle, "degrees clockwise from north, -360 to 360"));
  return way == "flat" ? ar::flat_tag(position, heading_rad) : ar::wall_tag(position, heading_rad);
}

void read_entry(const YamlValue& entry, std::optional<double> common_size_m, ar::TagMap& tags,
                std::map<int, int>& line_of_id) {
  const YamlMap map = entry.map({"id", "position", "flat", "wall", "orientation", "size"});
  const YamlValue id_value = map.require("id", "the tag's number");
  const int id = id_value.integer(0, highest_id(tags.family));
  if (const auto first = line_of_id.find(id); first != line_of_id.end()) {
    id_value.fail_found(fmt::format("{} a second time, first in line {}", id, first->second), "each tag once");
  }
  line_of_id[id] = id_value.line();
  const auto own_size = map.find("size");
  if (!own_size && !common_size_m) entry.fail_found("no size here nor for all tags", "size: metres above 0");
  tags.tags[id] = {read_world_from_tag(map), own_size ? read_positive(*own_size, "metres") : *common_size_m};
}

void read_map(const YamlMap& map, ar::TagMap& tags) {
  std::optional<double> common_size_m;
  if (const auto size = map.find("size")) common_size_m = read_positive(*size, "metres");
  const YamlValue list = map.require("map", "a list of tags");
  std::map<int, int> line_of_id;
  for (const YamlValue& entry : list.list()) read_entry(entry, common_size_m, tags, line_of_id);
  if (tags.tags.empty()) list.fail_found("an empty list", "at least one tag");
}

ar::TagMap read_tag_block(const YamlMap& map) {
  ar::TagMap tags;
  if (const auto family = map.find("family")) tags.family = family->one_of(ar::tag_families());
  read_map(map, tags);
  return tags;
}

}  // namespace

ar::TagMap read_tags(const YamlValue& value) {
  const YamlMap map = value.map({"family", "size", "map", "file"});
  const auto file = map.find("file");
  if (!file) return read_tag_block(map);
  for (const char* key : {"family", "size", "map"}) {
    if (const auto other = map.find(key)) other->fail_found("both file and " + std::string(key), "file alone, or map");
  }
  return read_tag_map(YamlValue::load(file->resolve(file->text("the path of a tag map")), "tag map"));
}

ar::TagMap read_tag_map(const YamlValue& root) {
  const YamlMap content = root.map({"skyshaft_tags", "family", "size", "map"});
  content.require("skyshaft_tags", "1, the version of this format").integer(1, 1);
  return read_tag_block(content);
}

}  // namespace app
