#pragma once

#include "app/scene_file/scene_file.h"
#include "app/scene_file/yaml_value.h"

namespace app {

// The sections of a scene file, each checked on its own.
ar::TagMap read_tags(const YamlValue& value);
// The whole of a tag map file.
ar::TagMap read_tag_map(const YamlValue& root);
SceneSky read_sky(const YamlValue& value);
SceneSun read_sun(const YamlValue& value);
render::Medium read_medium(const YamlValue& value);
SceneInstance read_object(const YamlValue& value);
SceneInstance read_real(const YamlValue& value);
SceneView read_view(const YamlValue& value);
double read_exposure(const YamlValue& value);
render::Quality read_quality(const YamlValue& value);

// Number checks with words for messages, used all over.
double read_heading_rad(const YamlValue& value);  // degrees from -360 to 360
double read_positive(const YamlValue& value, const std::string& unit);
glm::dvec3 read_position(const YamlValue& value);  // metres, finite

}  // namespace app
