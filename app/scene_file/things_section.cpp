// `objects:`, `real:`, `view:` and `quality:`.

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/error.h"
#include "app/options/shafts.h"
#include "app/scene_file/sections.h"
#include "ar/error.h"
#include "render/base/angles.h"

namespace app {
namespace {

std::shared_ptr<const render::Model> read_model(const YamlValue& value) {
  const std::filesystem::path path = value.resolve(value.text("the path of a .glb or .gltf file"));
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    value.fail_found(fmt::format("'{}', where there is no file", path.string()), "a .glb or .gltf file",
                     "paths are relative to the scene file's folder");
  }
  try {
    return std::make_shared<const render::Model>(render::load_gltf(path));
  } catch (const std::runtime_error& failure) {
    throw ar::InputError(fmt::format("{}: {}", value.where(), failure.what()));
  }
}

void read_placing(const YamlMap& map, SceneInstance& instance) {
  if (const auto position = map.find("position")) instance.position_in_world = read_position(*position);
  if (const auto heading = map.find("heading_deg")) instance.heading_rad = read_heading_rad(*heading);
  if (const auto scale = map.find("scale")) instance.scale = read_positive(*scale, "times the model's own size");
}

SceneInstance read_box(const YamlValue& value) {
  const YamlMap map = value.map({"size", "position", "heading_deg"});
  const YamlValue size_value = map.require("size", "[x, y, z] in metres, all above 0");
  const glm::dvec3 size_m = size_value.vector3("[x, y, z] in metres, all above 0");
  if (size_m.x <= 0.0 || size_m.y <= 0.0 || size_m.z <= 0.0) {
    size_value.fail_found("an edge that is not above 0", "[x, y, z] in metres, all above 0");
  }
  SceneInstance instance;
  instance.name = "box";
  instance.model = std::make_shared<const render::Model>(render::make_box(glm::vec3(size_m)));
  read_placing(map, instance);
  return instance;
}

SceneInstance read_plane(const YamlMap& map) {
  map.find("plane")->one_of({"ground"});
  SceneInstance instance;
  instance.name = "ground";
  instance.model = std::make_shared<const render::Model>(render::make_ground());
  if (const auto position = map.find("position")) instance.position_in_world = read_position(*position);
  return instance;
}

SceneInstance read_placed_model(const YamlMap& map) {
  const YamlValue path = map.require("model", "the path of a .glb or .gltf file");
  SceneInstance instance;
  instance.model = read_model(path);
  instance.name = instance.model->name;
  read_placing(map, instance);
  return instance;
}

}  // namespace

double read_heading_rad(const YamlValue& value) {
  return render::kRadPerDeg *
         value.number("degrees clockwise from north, -360 to 360", [](double x) { return std::abs(x) <= 360.0; });
}

double read_positive(const YamlValue& value, const std::string& unit) {
  return value.number("a number above 0 (" + unit + ")", [](double x) { return x > 0.0; });
}

glm::dvec3 read_position(const YamlValue& value) {
  return value.vector3("[east, north, up] in metres");
}

SceneInstance read_object(const YamlValue& value) {
  return read_placed_model(value.map({"model", "position", "heading_deg", "scale"}));
}

SceneInstance read_real(const YamlValue& value) {
  const YamlMap all = value.map({"plane", "box", "model", "position", "heading_deg", "scale"});
  const std::string kind = all.exactly_one_of({"plane", "box", "model"});
  SceneInstance instance;
  if (kind == "plane") instance = read_plane(value.map({"plane", "position"}));
  if (kind == "box") instance = read_box(*value.map({"box"}).find("box"));
  if (kind == "model") instance = read_placed_model(value.map({"model", "position", "heading_deg", "scale"}));
  instance.real = true;
  return instance;
}

SceneView read_view(const YamlValue& value) {
  const YamlMap map = value.map({"eye", "target", "up", "vertical_fov_deg"});
  SceneView view;
  view.eye_in_world = read_position(map.require("eye", "[east, north, up] in metres"));
  const YamlValue target = map.require("target", "[east, north, up] in metres");
  view.target_in_world = read_position(target);
  if (const auto up = map.find("up")) view.up_in_world = up->vector3("a direction [east, north, up]");
  const std::string accepted = "degrees above 0 and below 180";
  view.vertical_fov_rad = render::kRadPerDeg * map.require("vertical_fov_deg", accepted).number(accepted, [](double x) {
    return x > 0.0 && x < 180.0;
  });
  const glm::dvec3 forward = view.target_in_world - view.eye_in_world;
  if (glm::length(forward) <= 0.0) target.fail_found("the eye's own place", "a place to look at, other than the eye");
  const double sine = glm::length(glm::cross(forward, view.up_in_world));
  if (!(sine > 1e-9 * glm::length(forward) * glm::length(view.up_in_world))) {
    target.fail_found("a view along `up`", "`up` at an angle to the view, as up: [0, 1, 0]");
  }
  return view;
}

render::Quality read_quality(const YamlValue& value) {
  const YamlMap map = value.map({"shafts", "max_error", "target_ms", "shadow_map_size", "anti_alias"});
  render::Quality quality;
  if (const auto shafts = map.find("shafts")) {
    try {
      quality.shafts = parse_shafts(shafts->where(), shafts->text("auto or a technique"));
    } catch (const UsageError& error) {
      throw ar::InputError(error.what());
    }
  }
  if (const auto error = map.find("max_error")) {
    quality.shaft_demand.max_error =
        error->number("relative error above 0, at most 1", [](double x) { return x > 0.0 && x <= 1.0; });
  }
  if (const auto time = map.find("target_ms")) quality.shaft_demand.target_ms = read_positive(*time, "milliseconds");
  if (const auto size = map.find("shadow_map_size")) quality.shadow_map_size = size->integer(1, 8192);
  if (const auto anti_alias = map.find("anti_alias")) quality.anti_alias = anti_alias->boolean();
  return quality;
}

}  // namespace app
