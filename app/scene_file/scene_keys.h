#pragma once

#include "app/scene_file/key_table.h"
#include "app/scene_file/scene_file.h"

namespace app {

// What is written for all tags before the list, and the tags.
struct TagBlock {
  ar::TagMap map;
  std::optional<double> common_size_m;
};

// One tag of the list.
struct TagEntry {
  int id = 0;
  glm::dvec3 position_in_world{0.0};
  ar::Rigid3 world_from_tag;  // its position is taken from position_in_world once all keys are read
  std::optional<double> size_m;
};

// The keys of a scene file, map by map. The parser, docs/scene-file.md and data/scene.schema.json come from these
// tables: a new key is a row here and a member of what it goes into, and `skyshaft-scene-docs` writes the other two.
const KeyTable<SceneFile>& scene_keys();  // the whole file
const KeyTable<ar::GeoPosition>& place_keys();
const KeyTable<TagBlock>& tags_keys();
const KeyTable<TagBlock>& tag_map_file_keys();  // the whole of a tag map file
const KeyTable<SceneSky>& sky_keys();
const KeyTable<render::Medium>& medium_keys();
const KeyTable<SceneInstance>& object_keys();
const KeyTable<SceneInstance>& real_keys();
const KeyTable<SceneView>& view_keys();
const KeyTable<render::GivenSun>& sun_keys();
const KeyTable<double>& exposure_keys();  // display-linear per cd/m2
const KeyTable<render::Quality>& quality_keys();

}  // namespace app
