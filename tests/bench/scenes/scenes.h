#pragma once

#include <string>
#include <vector>

#include "render/scene/model.h"

// The standard scenes that light shafts are measured on, made by formula: always the same bytes.
namespace bench_scenes {

// How finely a scene's parts are made.
enum class Detail { Coarse, Fine };  // about 66,000 and 188,000 triangles

// A wood of broad-leaved trees on uneven ground, the sun low behind the crowns.
render::Model make_forest(Detail detail);

// A castle gate of rough ashlar: an arch with its portcullis half down between two round towers, cobbles before it; the
// sun shines through from behind.
render::Model make_gate(Detail detail);

// A bare room with two tall windows in its south wall, a table and two benches of timber.
render::Model make_room();

// A scene file for `model`.glb beside it.
std::string forest_yaml(const std::string& model);
std::string gate_yaml(const std::string& model);
std::string room_yaml(const std::string& model);

// Appends a rough material with that base colour texture (first image) and normal map (second, where there is one).
int add_material(render::Model& model, const std::string& name, std::vector<render::Image> images, float roughness);
int add_material(render::Model& model, const std::string& name, const glm::vec3& linear_rgb, float roughness);

}  // namespace bench_scenes
