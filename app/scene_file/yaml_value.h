#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace app {

class YamlMap;

// A value of a YAML file that knows where it stands. Every check that fails throws ar::InputError as
//   FILE:LINE: KEY: found X; accepted: Y
// with what to do on a second line where there is more to say. LINE counts from 1.
class YamlValue {
 public:
  // The only document of the file. `what` names the kind of file in messages ("scene file").
  static YamlValue load(const std::filesystem::path& file, const std::string& what);

  // A map whose keys are all among `known`, none of them twice. Keys of `not_yet` belong to the format but do nothing
  // in this version: only an empty list may stand there.
  YamlMap map(const std::vector<std::string>& known, const std::vector<std::string>& not_yet = {}) const;
  std::vector<YamlValue> list() const;

  // Scalars. `accepted` describes the legal values in messages; `legal` decides. Numbers are always finite.
  double number(const std::string& accepted, const std::function<bool(double)>& legal) const;
  int integer(int minimum, int maximum) const;
  bool boolean() const;
  std::string text(const std::string& accepted) const;
  std::string one_of(const std::vector<std::string>& choices) const;
  // Exactly three numbers.
  glm::dvec3 vector3(const std::string& accepted) const;

  bool is_map() const { return node_.IsMap(); }
  // Of a map, whatever else is in it: tells formats apart.
  bool has(const std::string& key) const { return node_.IsMap() && node_[key].IsDefined(); }
  bool is_scalar() const { return node_.IsScalar(); }
  bool is_list() const { return node_.IsSequence(); }

  // "scene.yaml:12: medium.g", for messages of checks that are made later.
  std::string where() const;
  int line() const;  // from 1
  const std::filesystem::path& file() const { return file_; }
  // An absolute or working-directory path for a path that is written relative to the file.
  std::filesystem::path resolve(const std::string& path) const;

  [[noreturn]] void fail(const std::string& accepted, const std::string& to_do = "") const;
  [[noreturn]] void fail_found(const std::string& found, const std::string& accepted,
                               const std::string& to_do = "") const;

 private:
  friend class YamlMap;
  YamlValue(const YAML::Node& node, std::filesystem::path file, std::string key);
  YamlValue child(const YAML::Node& node, const std::string& key) const;
  double finite_number(const std::string& accepted) const;
  std::string found() const;

  YAML::Node node_;
  std::filesystem::path file_;
  std::string key_;  // "medium.extent.box[0]"; empty for the whole document
};

// The entries of a checked map.
class YamlMap {
 public:
  YamlMap(const YamlValue& value, const std::vector<std::string>& known, const std::vector<std::string>& not_yet);

  std::optional<YamlValue> find(const std::string& key) const;
  YamlValue require(const std::string& key, const std::string& accepted) const;
  // The one key of `choices` that is there; fails when none or several are.
  std::string exactly_one_of(const std::vector<std::string>& choices) const;
  double number_or(const std::string& key, double otherwise, const std::string& accepted,
                   const std::function<bool(double)>& legal) const;
  const YamlValue& value() const { return value_; }

 private:
  void check_key(const YAML::Node& key, const std::vector<std::string>& known,
                 const std::vector<std::string>& not_yet) const;

  YamlValue value_;
};

}  // namespace app
