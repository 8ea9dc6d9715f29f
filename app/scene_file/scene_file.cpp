#include "app/scene_file/scene_file.h"

#include "app/scene_file/scene_keys.h"
#include "app/scene_file/sections.h"
#include "render/base/angles.h"

namespace app {

SceneFile load_scene_file(const std::filesystem::path& path) {
  const YamlValue root = YamlValue::load(path, "scene file");
  SceneFile scene;
  scene.path = path;
  scene_keys().read(root, scene);
  if (scene.sky.where.empty()) scene.sky.where = root.where();
  return scene;
}

double read_exposure(const YamlValue& value) {
  double exposure = 0.0;
  exposure_keys().read(value, exposure);
  return exposure;
}

double read_heading_rad(const YamlValue& value) {
  return render::kRadPerDeg * read_number(value, shapes::heading());
}

double read_positive(const YamlValue& value, const std::string& unit) {
  return read_number(value, shapes::number_above_0(unit));
}

glm::dvec3 read_position(const YamlValue& value) {
  return read_vector(value, shapes::world_position());
}

}  // namespace app
