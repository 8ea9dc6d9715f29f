// `tags:` and the tag map files that it may name.

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "app/scene_file/scene_keys.h"
#include "app/scene_file/sections.h"
#include "ar/track/detector.h"
#include "ar/track/tag_face.h"
#include "render/base/angles.h"

namespace app {
namespace {

const int kHighestId = 48713;  // of all families: tagStandard52h13's

cv::Vec3d to_cv(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

// One angle in a map of its own: { top_edge_heading_deg: 20 }.
struct Facing {
  double heading_rad = 0.0;
};

KeyTable<Facing> make_facing_keys(const std::string& key, const std::string& meaning, const std::string& example) {
  KeyTable<Facing> table;
  table.number(key, shapes::heading(), &Facing::heading_rad, {meaning, example}, render::kRadPerDeg)
      .required()
      .example("{ " + key + ": " + example + " }");
  return table;
}

const KeyTable<Facing>& flat_keys() {
  static const KeyTable<Facing> table =
      make_facing_keys("top_edge_heading_deg", "Direction from the tag's centre to its top edge.", "225");
  return table;
}

const KeyTable<Facing>& wall_keys() {
  static const KeyTable<Facing> table =
      make_facing_keys("faces_heading_deg", "Direction in which the normal of the printed face points.", "200");
  return table;
}

void read_flat(const YamlValue& value, TagEntry& tag) {
  Facing facing;
  flat_keys().read(value, facing);
  tag.world_from_tag = ar::flat_tag({}, facing.heading_rad);
}

void read_wall(const YamlValue& value, TagEntry& tag) {
  Facing facing;
  wall_keys().read(value, facing);
  tag.world_from_tag = ar::wall_tag({}, facing.heading_rad);
}

ValueShape orientation_shape() {
  return shapes::numbers(4, "a unit quaternion [w, x, y, z] that takes the tag's frame into the world");
}

void read_orientation(const YamlValue& value, TagEntry& tag) {
  const std::vector<double> parts = read_numbers(value, orientation_shape());
  const cv::Vec4d wxyz(parts[0], parts[1], parts[2], parts[3]);
  const double length = cv::norm(wxyz);
  // Three decimals a component are enough to be called a unit quaternion; it is normalised after the check.
  if (std::abs(length - 1.0) > 0.005) {
    value.fail_found(fmt::format("a quaternion of length {:.4f}", length), accepted(orientation_shape()));
  }
  tag.world_from_tag.rotation = ar::rotation_from_quaternion_wxyz(wxyz / length);
}

KeyTable<TagEntry> make_tag_keys() {
  KeyTable<TagEntry> table;
  table.exactly_one_of({"flat", "wall", "orientation"})
      .integer("id", shapes::integer_from_to(0, kHighestId), &TagEntry::id,
               {"The tag's number, each once and within the family.", "7"})
      .required()
      .vector("position", shapes::world_position(), &TagEntry::position_in_world,
              {"Where its centre is.", "[1.8, 1.75, 0.006]"})
      .required()
      .add("flat", shapes::map_of(flat_keys().shape()), read_flat, {"It lies face up.", flat_keys().shape().example})
      .add("wall", shapes::map_of(wall_keys().shape()), read_wall,
           {"It hangs upright on a wall.", wall_keys().shape().example})
      .add(
          "orientation", orientation_shape(), read_orientation,
          {"Any other way: rotation from AprilTag's frame (x right, y down, z into the tag).", "[0.5, 0.5, -0.5, 0.5]"})
      .number("size", shapes::number_above_0("metres"), &TagEntry::size_m,
              {"Outer edge of the black border (the white one of inverted families).", "0.16"})
      .or_else("the size for all tags")
      .example("{ id: 7, position: [1.8, 1.75, 0.006], flat: { top_edge_heading_deg: 225 }, size: 0.5 }");
  return table;
}

const KeyTable<TagEntry>& tag_keys() {
  static const KeyTable<TagEntry> table = make_tag_keys();
  return table;
}

void add_tag(const YamlValue& item, int highest_id, TagBlock& block, std::map<int, int>& line_of_id) {
  TagEntry tag;
  tag_keys().read(item, tag);
  const YamlValue id = *item.map(tag_keys().shape().names()).find("id");
  id.integer(0, highest_id);
  if (const auto first = line_of_id.find(tag.id); first != line_of_id.end()) {
    id.fail_found(fmt::format("{} a second time, first in line {}", tag.id, first->second), "each tag once");
  }
  line_of_id[tag.id] = id.line();
  if (!tag.size_m && !block.common_size_m) item.fail_found("no size here nor for all tags", "size: metres above 0");
  tag.world_from_tag.translation = to_cv(tag.position_in_world);
  block.map.tags[tag.id] = {tag.world_from_tag, tag.size_m ? *tag.size_m : *block.common_size_m};
}

void read_list(const YamlValue& list, TagBlock& block) {
  std::map<int, int> line_of_id;
  const int highest_id = ar::tag_count(block.map.family) - 1;
  for (const YamlValue& item : list.list()) add_tag(item, highest_id, block, line_of_id);
  if (block.map.tags.empty()) list.fail_found("an empty list", "at least one tag");
}

void read_file(const YamlValue& value, TagBlock& block) {
  const YamlValue root = YamlValue::load(value.resolve(value.text("the path of a tag map")), "tag map");
  block.map = read_tag_map(root);
}

// The keys that a tag map file and the scene's `tags` share. Family and size come first: the list needs them.
void add_block(KeyTable<TagBlock>& table) {
  std::vector<std::pair<std::string, std::string>> families;
  for (const std::string& family : ar::tag_families()) families.emplace_back(family, family);
  table
      .word("family", families, [](TagBlock& block) -> std::string& { return block.map.family; },
            {"AprilTag family of all tags.", "tag36h11"})
      .only_with({"map"})
      .number("size", shapes::number_above_0("metres"), &TagBlock::common_size_m,
              {"Size of all tags that give none: outer edge of the black border.", "0.5"})
      .only_with({"map"})
      .add("map", shapes::list_of(tag_keys().shape()), read_list,
           {"The tags, at least one.", tag_keys().shape().example});
}

}  // namespace

const KeyTable<TagBlock>& tags_keys() {
  static const KeyTable<TagBlock> table = [] {
    KeyTable<TagBlock> made;
    add_block(made);
    made.add("file", shapes::text("the path of a tag map"), read_file,
             {"A tag map made by `skyshaft map`, in place of the other keys; relative to the scene file's folder.",
              "tags.yaml"})
        .exactly_one_of({"map", "file"})
        .example("{ family: tag36h11, size: 0.5, map: [" + tag_keys().shape().example + "] }");
    return made;
  }();
  return table;
}

const KeyTable<TagBlock>& tag_map_file_keys() {
  static const KeyTable<TagBlock> table = [] {
    KeyTable<TagBlock> made;
    made.add("skyshaft_tags", shapes::number_from_to(1.0, 1.0, "", "the version of this format"),
             [](const YamlValue& value, TagBlock&) { value.integer(1, 1); }, {"The version of this format.", "1"})
        .required();
    add_block(made);
    made.required().example("{ skyshaft_tags: 1, size: 0.5, map: [" + tag_keys().shape().example + "] }");
    return made;
  }();
  return table;
}

ar::TagMap read_tags(const YamlValue& value) {
  TagBlock block;
  tags_keys().read(value, block);
  return block.map;
}

ar::TagMap read_tag_map(const YamlValue& root) {
  TagBlock block;
  tag_map_file_keys().read(root, block);
  return block.map;
}

}  // namespace app
