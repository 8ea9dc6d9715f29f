// data/scene.schema.json.

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "app/scene_file/key_documents.h"
#include "app/scene_file/scene_keys.h"

namespace app {
namespace {

using Json = nlohmann::ordered_json;

Json number_json(double value) {
  if (value == std::floor(value)) return static_cast<std::int64_t>(value);
  return value;
}

Json range_schema(const char* type, const Range& range) {
  Json schema = {{"type", type}};
  if (range.least) schema[range.least_excluded ? "exclusiveMinimum" : "minimum"] = number_json(*range.least);
  if (range.most) schema[range.most_excluded ? "exclusiveMaximum" : "maximum"] = number_json(*range.most);
  return schema;
}

Json list_schema(const Json& items, std::size_t count) {
  return {{"type", "array"}, {"items", items}, {"minItems", count}, {"maxItems", count}};
}

Json word_schema(const ValueShape& shape) {
  const Json listed = {{"type", "string"}, {"enum", shape.words}};
  if (shape.pattern.empty()) return listed;
  return {{"anyOf", Json::array({listed, {{"type", "string"}, {"pattern", shape.pattern}}})}};
}

Json map_schema(const MapShape& map);

Json value_schema(const ValueShape& shape) {
  switch (shape.kind) {
    case ValueKind::Number:
      return range_schema("number", shape.range);
    case ValueKind::Integer:
      return range_schema("integer", shape.range);
    case ValueKind::Boolean:
      return {{"type", "boolean"}};
    case ValueKind::Word:
      return word_schema(shape);
    case ValueKind::Text:
      return {{"type", "string"}, {"minLength", 1}};
    case ValueKind::Numbers:
      return list_schema(range_schema("number", shape.range), shape.count);
    case ValueKind::Corners:
      return list_schema(list_schema({{"type", "number"}}, 3), 2);
    case ValueKind::Map:
      return map_schema(*shape.map);
    case ValueKind::List:
      return {{"type", "array"}, {"items", map_schema(*shape.map)}};
  }
  return Json::object();
}

// Of a map or a list the keys below say the accepted values.
std::string description(const KeyShape& key) {
  const bool has_keys = key.value.map != nullptr;
  std::string text = key.meaning;
  if (!has_keys) text += "\nAccepted: " + accepted(key.value) + ".";
  if (!key.default_text.empty()) text += "\nDefault: " + key.default_text + ".";
  return text;
}

Json required_any(const std::vector<std::string>& names, const char* how) {
  Json choices = Json::array();
  for (const std::string& name : names) choices.push_back({{"required", Json::array({name})}});
  return {{how, choices}};
}

Json strict_map_schema(const MapShape& map) {
  Json schema = {{"type", "object"}, {"additionalProperties", false}};
  Json required = Json::array();
  for (const KeyShape& key : map.keys) {
    Json value = value_schema(key.value);
    value["description"] = description(key);
    schema["properties"][key.name] = value;
    if (key.required) required.push_back(key.name);
    if (!key.only_with.empty()) schema["dependencies"][key.name] = required_any(key.only_with, "anyOf");
  }
  for (const std::string& name : map.not_yet) {
    schema["properties"][name] = {{"type", "array"}, {"maxItems", 0}, {"description", "Does nothing yet."}};
  }
  if (!required.empty()) schema["required"] = required;
  if (!map.exactly_one_of.empty()) schema.update(required_any(map.exactly_one_of, "oneOf"));
  return schema;
}

Json map_schema(const MapShape& map) {
  const Json strict = strict_map_schema(map);
  if (map.bare_key.empty()) return strict;
  return {{"anyOf", Json::array({value_schema(map.key(map.bare_key).value), strict})}};
}

}  // namespace

std::string scene_schema() {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Skyshaft scene file"}};
  schema.update(map_schema(scene_keys().shape()));
  return schema.dump(2) + "\n";
}

}  // namespace app
