#pragma once

#include "app/scene_file/scene_file.h"
#include "app/scene_file/yaml_value.h"

namespace app {

// Parts of a scene file that other files have, too.
ar::TagMap read_tags(const YamlValue& value);
// The whole of a tag map file.
ar::TagMap read_tag_map(const YamlValue& root);
double read_exposure(const YamlValue& value);

// Number checks with words for messages, used all over.
double read_heading_rad(const YamlValue& value);  // degrees from -360 to 360
double read_positive(const YamlValue& value, const std::string& unit);
glm::dvec3 read_position(const YamlValue& value);  // metres, finite

}  // namespace app
