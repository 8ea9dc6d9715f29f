#include "app/scene_file/yaml_edit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <stdexcept>

namespace app {
namespace {

using Path = std::vector<std::string>;

[[noreturn]] void fail(const Path& path, const std::string& why) {
  throw std::runtime_error(fmt::format("{}: {}", fmt::join(path, "."), why));
}

// "{ preset: light }" of the keys from `first` on, or the bare value after the last.
std::string nested(const Path& path, std::size_t first, const std::string& value) {
  if (first == path.size()) return value;
  return fmt::format("{{ {}: {} }}", path[first], nested(path, first + 1, value));
}

std::size_t position_of(const YAML::Node& node) {
  return static_cast<std::size_t>(node.Mark().pos);
}

// One past the last character of the scalar that begins there.
std::size_t end_of_scalar(const std::string& text, std::size_t begin, bool in_flow) {
  const char quote = text.at(begin);
  if (quote == '"' || quote == '\'') {
    for (std::size_t i = begin + 1; i < text.size(); ++i) {
      if (quote == '"' && text[i] == '\\') {
        ++i;
      } else if (text[i] == quote) {
        if (quote == '\'' && i + 1 < text.size() && text[i + 1] == quote) {
          ++i;
        } else {
          return i + 1;
        }
      }
    }
    return text.size();
  }
  std::size_t end = begin;
  while (end < text.size() && text[end] != '\n') {
    const bool comment = text[end] == '#' && end > begin && text[end - 1] == ' ';
    const bool flow_end = in_flow && (text[end] == ',' || text[end] == '}' || text[end] == ']');
    if (comment || flow_end) break;
    ++end;
  }
  while (end > begin && (text[end - 1] == ' ' || text[end - 1] == '\r')) --end;
  return end;
}

bool is_flow(const YAML::Node& node) {
  return node.Style() == YAML::EmitterStyle::Flow;
}

// `map` gets the entry, in front of what it has.
std::string with_new_entry(std::string text, const YAML::Node& map, const std::string& entry) {
  const std::size_t at = position_of(map);
  if (is_flow(map)) {
    const std::string more = map.size() > 0 ? entry + "," : entry + " ";
    return text.insert(at + 1, " " + more);
  }
  const std::string indent(static_cast<std::size_t>(map.Mark().column), ' ');
  return text.insert(at, entry + "\n" + indent);
}

std::string edited(const std::string& text, const Path& path, const std::string& value, const std::string& scalar_key) {
  const YAML::Node root = YAML::Load(text);
  if (!root.IsMap()) fail(path, "the file is not a map");
  YAML::Node node = root;
  bool in_flow = false;
  for (std::size_t depth = 0; depth < path.size(); ++depth) {
    in_flow = in_flow || is_flow(node);
    const YAML::Node child = static_cast<const YAML::Node&>(node)[path[depth]];
    if (!child || child.IsNull()) {
      const std::string entry = path[depth] + ": " + nested(path, depth + 1, value);
      if (child) fail(path, "has a key without a value");
      if (depth > 0) return with_new_entry(text, node, entry);
      return text + (text.empty() || text.back() == '\n' ? "" : "\n") + entry + "\n";
    }
    if (child.IsScalar()) {
      const std::size_t begin = position_of(child);
      const std::size_t end = end_of_scalar(text, begin, in_flow);
      const std::string was = text.substr(begin, end - begin);
      const std::string now = depth + 1 == path.size() ? value
                                                       : fmt::format("{{ {}: {}, {}: {} }}", scalar_key, was,
                                                                     path[depth + 1], nested(path, depth + 2, value));
      return text.substr(0, begin) + now + text.substr(end);
    }
    if (!child.IsMap()) fail(path, "leads through a list");
    node.reset(child);
  }
  fail(path, "is a map, not a value");
}

}  // namespace

std::string with_yaml_value(const std::string& text, const Path& path, const std::string& value,
                            const std::string& scalar_key) {
  try {
    std::string made = edited(text, path, value, scalar_key);
    YAML::Node found = YAML::Load(made);
    for (const std::string& key : path) found.reset(static_cast<const YAML::Node&>(found)[key]);
    if (!found.IsScalar() || found.Scalar() != YAML::Load(value).Scalar()) fail(path, "cannot be changed in place");
    return made;
  } catch (const YAML::Exception& error) {
    fail(path, error.what());
  }
}

}  // namespace app
