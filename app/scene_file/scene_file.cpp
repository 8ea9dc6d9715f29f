#include "app/scene_file/scene_file.h"

#include <cmath>
#include <stdexcept>

#include "app/scene_file/sections.h"

namespace app {
namespace {

ar::GeoPosition read_place(const YamlValue& value) {
  const YamlMap map = value.map({"latitude", "longitude", "height"});
  const std::string latitude = "degrees from -90 to 90, north positive";
  const std::string longitude = "degrees from -180 to 180, east positive";
  ar::GeoPosition place;
  place.latitude_deg = map.require("latitude", latitude).number(latitude, [](double x) { return std::abs(x) <= 90.0; });
  place.longitude_deg =
      map.require("longitude", longitude).number(longitude, [](double x) { return std::abs(x) <= 180.0; });
  place.height_m =
      map.number_or("height", 0.0, "metres from -500 to 100000", [](double x) { return x >= -500.0 && x <= 100000.0; });
  return place;
}

ar::UtcTime read_time(const YamlValue& value) {
  const std::string accepted = "UTC or a time with an offset, as 2024-06-21T07:30:00Z or 2024-06-21 09:30+02:00";
  const std::string text = value.text(accepted);
  try {
    return ar::parse_time(text);
  } catch (const std::invalid_argument&) {
    value.fail(accepted);
  }
}

void check_version(const YamlMap& map) {
  const YamlValue version = map.require("skyshaft", "1, the version of this format");
  version.number("1, the version of this format", [](double x) { return x == 1.0; });
}

void read_instances(const YamlMap& map, SceneFile& scene) {
  if (const auto objects = map.find("objects")) {
    for (const YamlValue& item : objects->list()) scene.instances.push_back(read_object(item));
  }
  if (const auto real = map.find("real")) {
    for (const YamlValue& item : real->list()) scene.instances.push_back(read_real(item));
  }
}

}  // namespace

SceneFile load_scene_file(const std::filesystem::path& path) {
  const YamlValue root = YamlValue::load(path, "scene file");
  const YamlMap map = root.map(
      {"skyshaft", "place", "time", "tags", "sky", "medium", "objects", "real", "view", "sun", "exposure", "quality"},
      {"lights", "portals"});
  check_version(map);
  SceneFile scene;
  scene.path = path;
  if (const auto value = map.find("place")) scene.place = read_place(*value);
  if (const auto value = map.find("time")) scene.time = read_time(*value);
  if (const auto value = map.find("tags")) scene.tags = read_tags(*value);
  scene.sky.where = root.where();
  if (const auto value = map.find("sky")) scene.sky = read_sky(*value);
  if (const auto value = map.find("medium")) scene.medium = read_medium(*value);
  if (const auto value = map.find("view")) scene.view = read_view(*value);
  if (const auto value = map.find("sun")) scene.sun = read_sun(*value);
  if (const auto value = map.find("exposure")) scene.exposure = read_exposure(*value);
  if (const auto value = map.find("quality")) scene.quality = read_quality(*value);
  read_instances(map, scene);
  return scene;
}

}  // namespace app
