#include "app/scene_file/key_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "app/options/words.h"

namespace app {
namespace {

bool has_any(const YamlMap& map, const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) { return map.find(name).has_value(); });
}

void check_company(const YamlMap& map, const MapShape& shape) {
  for (const KeyShape& key : shape.keys) {
    const auto value = map.find(key.name);
    if (!value || key.only_with.empty() || has_any(map, key.only_with)) continue;
    // Where another of the choices is there, the key is one too many; else its company is missing.
    const auto& choices = shape.exactly_one_of;
    const bool is_choice = std::find(choices.begin(), choices.end(), key.only_with.front()) != choices.end();
    if (!is_choice && key.only_with.size() == 1) {
      const KeyShape& other = shape.key(key.only_with.front());
      map.value().fail_found(fmt::format("no '{}' beside '{}'", other.name, key.name),
                             fmt::format("{}: {}", other.name, accepted(other.value)));
    }
    value->fail_found(fmt::format("'{}' without {}", key.name, join_or(key.only_with)),
                      fmt::format("{} beside {} only", key.name, join_or(key.only_with)));
  }
}

}  // namespace

std::vector<std::string> MapShape::names() const {
  std::vector<std::string> names;
  for (const KeyShape& key : keys) names.push_back(key.name);
  return names;
}

const KeyShape& MapShape::key(const std::string& name) const {
  for (const KeyShape& key : keys) {
    if (key.name == name) return key;
  }
  throw std::logic_error("no key " + name + " in this map's table");
}

YamlMap checked_map(const YamlValue& value, const MapShape& shape) {
  const YamlMap map = value.map(shape.names(), shape.not_yet);
  if (!shape.exactly_one_of.empty()) map.exactly_one_of(shape.exactly_one_of);
  for (const KeyShape& key : shape.keys) {
    if (key.required) map.require(key.name, accepted(key.value));
  }
  check_company(map, shape);
  return map;
}

std::string default_text_of(double value) {
  // Seven digits hide the last bits of angles that went through radians.
  return fmt::format("{:.7g}", value);
}

std::string default_text_of(const glm::dvec3& value) {
  return fmt::format("[{:.7g}, {:.7g}, {:.7g}]", value.x, value.y, value.z);
}

std::string default_text_of(bool value) {
  return value ? "true" : "false";
}

}  // namespace app
