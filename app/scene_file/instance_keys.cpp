// `objects:` and `real:`.

#include <fmt/format.h>

#include "app/scene_file/scene_keys.h"
#include "ar/error.h"
#include "render/base/angles.h"

namespace app {
namespace {

const char* const kModelFile = "the path of a .glb or .gltf file";

void read_model(const YamlValue& value, SceneInstance& instance) {
  const std::filesystem::path path = value.resolve(value.text(kModelFile));
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    value.fail_found(fmt::format("'{}', where there is no file", path.string()), "a .glb or .gltf file",
                     "paths are relative to the scene file's folder");
  }
  try {
    instance.model = std::make_shared<const render::Model>(render::load_gltf(path));
  } catch (const std::runtime_error& failure) {
    throw ar::InputError(fmt::format("{}: {}", value.where(), failure.what()));
  }
  instance.name = instance.model->name;
}

void read_plane(const YamlValue& value, SceneInstance& instance) {
  value.one_of({"ground"});
  instance.name = "ground";
  instance.model = std::make_shared<const render::Model>(render::make_ground());
}

ValueShape box_size_shape() {
  return shapes::numbers(3, "[x, y, z]", "metres", {.least = 0.0, .least_excluded = true});
}

void read_box_size(const YamlValue& value, SceneInstance& instance) {
  const glm::dvec3 size_m = read_vector(value, box_size_shape());
  instance.name = "box";
  instance.model = std::make_shared<const render::Model>(render::make_box(glm::vec3(size_m)));
}

KeyTable<SceneInstance>& add_position(KeyTable<SceneInstance>& table, const std::string& what, const char* example) {
  return table.vector("position", shapes::world_position(), &SceneInstance::position_in_world, {what, example});
}

KeyTable<SceneInstance>& add_heading(KeyTable<SceneInstance>& table) {
  return table.number("heading_deg", shapes::heading(), &SceneInstance::heading_rad,
                      {"Turns it about the vertical; at 0 a model's -z axis faces north.", "60"}, render::kRadPerDeg);
}

KeyTable<SceneInstance>& add_scale(KeyTable<SceneInstance>& table) {
  return table.number("scale", shapes::number_above_0("times the model's own size"), &SceneInstance::scale,
                      {"Scales the model.", "1.5"});
}

const KeyTable<SceneInstance>& box_keys() {
  static const KeyTable<SceneInstance> table = [] {
    KeyTable<SceneInstance> made;
    made.add("size", box_size_shape(), read_box_size, {"Its edges.", "[1, 1, 0.4]"}).required();
    add_position(made, "Where its centre is.", "[0, 1, 0.2]");
    add_heading(made).example("{ size: [1, 1, 0.4], position: [0, 1, 0.2], heading_deg: 45 }");
    return made;
  }();
  return table;
}

KeyTable<SceneInstance> make_object_keys() {
  KeyTable<SceneInstance> table;
  table
      .add("model", shapes::text(kModelFile), read_model,
           {"A glTF 2.0 model; relative to the scene file's folder.", "../models/pergola.glb"})
      .required();
  add_position(table, "Where the model's origin is.", "[-0.35, -0.35, 0]");
  add_heading(table);
  add_scale(table).example("{ model: ../models/pergola.glb, position: [0, 0, 0], heading_deg: 30 }");
  return table;
}

KeyTable<SceneInstance> make_real_keys() {
  KeyTable<SceneInstance> table;
  table.exactly_one_of({"plane", "box", "model"})
      .add("plane", shapes::one_word_of({"ground"}), read_plane, {"Level ground without end.", "ground"})
      .add("box", shapes::map_of(box_keys().shape()),
           [](const YamlValue& value, SceneInstance& instance) { box_keys().read(value, instance); },
           {"A box of that size.", box_keys().shape().example})
      .add("model", shapes::text(kModelFile), read_model,
           {"A glTF 2.0 model of the real thing; relative to the scene file's folder.", "../models/gate.glb"});
  add_position(table, "Where the model's origin, or a point of the ground, is.", "[0, 0, 0.1]")
      .only_with({"plane", "model"});
  add_heading(table).only_with({"model"});
  add_scale(table)
      .only_with({"model"})
      .example("{ plane: ground }")
      .finish([](const YamlMap&, SceneInstance& instance) { instance.real = true; });
  return table;
}

}  // namespace

const KeyTable<SceneInstance>& object_keys() {
  static const KeyTable<SceneInstance> table = make_object_keys();
  return table;
}

const KeyTable<SceneInstance>& real_keys() {
  static const KeyTable<SceneInstance> table = make_real_keys();
  return table;
}

}  // namespace app
