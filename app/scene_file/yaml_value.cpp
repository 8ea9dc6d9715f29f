#include "app/scene_file/yaml_value.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <system_error>

#include "app/options/words.h"
#include "ar/error.h"
#include "render/base/number.h"

namespace app {
namespace {

std::string read_whole(const std::filesystem::path& file, const std::string& what) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    throw ar::InputError(fmt::format("{}: no such {}\ncheck the path", file.string(), what));
  }
  std::ifstream in(file, std::ios::binary);
  if (std::filesystem::is_directory(file, error) || !in) {
    throw ar::InputError(fmt::format("{}: cannot be read as a {}\nname a readable YAML file", file.string(), what));
  }
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

YamlValue::YamlValue(const YAML::Node& node, std::filesystem::path file, std::string key)
    : node_(node), file_(std::move(file)), key_(std::move(key)) {}

YamlValue YamlValue::load(const std::filesystem::path& file, const std::string& what) {
  const std::string text = read_whole(file, what);
  std::vector<YAML::Node> documents;
  try {
    documents = YAML::LoadAll(text);
  } catch (const YAML::ParserException& error) {
    throw ar::InputError(fmt::format("{}:{}: not YAML: {} (column {})\ncheck indentation, colons and brackets there",
                                     file.string(), error.mark.line + 1, error.msg, error.mark.column + 1));
  }
  if (documents.empty() || documents.front().IsNull()) {
    throw ar::InputError(fmt::format("{}: is empty\na {} starts with `skyshaft: 1`", file.string(), what));
  }
  if (documents.size() > 1) {
    throw ar::InputError(fmt::format("{}:{}: found a second document; accepted: one a file\nremove the `---` line",
                                     file.string(), documents[1].Mark().line + 1));
  }
  return {documents.front(), file, ""};
}

YamlMap YamlValue::map(const std::vector<std::string>& known, const std::vector<std::string>& not_yet) const {
  return {*this, known, not_yet};
}

std::vector<YamlValue> YamlValue::list() const {
  if (!node_.IsSequence()) fail("a list");
  std::vector<YamlValue> items;
  for (std::size_t i = 0; i < node_.size(); ++i) items.push_back(child(node_[i], fmt::format("{}[{}]", key_, i)));
  return items;
}

double YamlValue::finite_number(const std::string& accepted) const {
  // A quoted scalar carries the tag "!": it is text even if it looks like a number.
  if (!node_.IsScalar() || node_.Tag() == "!") fail(accepted);
  const std::optional<double> value = render::parse_number(node_.Scalar());
  if (!value || !std::isfinite(*value)) fail(accepted);
  return *value;
}

double YamlValue::number(const std::string& accepted, const std::function<bool(double)>& legal) const {
  const double value = finite_number(accepted);
  if (!legal(value)) fail(accepted);
  return value;
}

int YamlValue::integer(int minimum, int maximum) const {
  const std::string accepted = fmt::format("a whole number from {} to {}", minimum, maximum);
  const double value = finite_number(accepted);
  if (value != std::floor(value) || value < minimum || value > maximum) fail(accepted);
  return static_cast<int>(value);
}

bool YamlValue::boolean() const {
  const std::string word = node_.IsScalar() ? node_.Scalar() : "";
  if (word != "true" && word != "false") fail("true or false");
  return word == "true";
}

std::string YamlValue::text(const std::string& accepted) const {
  if (!node_.IsScalar() || node_.Scalar().empty()) fail(accepted);
  return node_.Scalar();
}

std::string YamlValue::one_of(const std::vector<std::string>& choices) const {
  const std::string word = node_.IsScalar() ? node_.Scalar() : "";
  for (const std::string& choice : choices) {
    if (choice == word) return word;
  }
  const std::string meant = closest(word, choices);
  fail(join_or(choices), meant.empty() ? "" : fmt::format("did you mean '{}'?", meant));
}

glm::dvec3 YamlValue::vector3(const std::string& accepted) const {
  if (!node_.IsSequence() || node_.size() != 3) fail(accepted);
  const auto items = list();
  glm::dvec3 vector{0.0};
  for (int i = 0; i < 3; ++i) vector[i] = items[static_cast<std::size_t>(i)].finite_number("a finite number");
  return vector;
}

int YamlValue::line() const {
  return node_.Mark().line + 1;
}

std::string YamlValue::where() const {
  return key_.empty() ? fmt::format("{}:{}", file_.string(), line())
                      : fmt::format("{}:{}: {}", file_.string(), line(), key_);
}

std::filesystem::path YamlValue::resolve(const std::string& path) const {
  const std::filesystem::path written(path);
  return written.is_absolute() ? written : file_.parent_path() / written;
}

std::string YamlValue::found() const {
  switch (node_.Type()) {
    case YAML::NodeType::Scalar:
      return node_.Tag() == "!" ? fmt::format("the text '{}'", node_.Scalar()) : fmt::format("'{}'", node_.Scalar());
    case YAML::NodeType::Sequence:
      return fmt::format("a list of {}", node_.size());
    case YAML::NodeType::Map:
      return "a map";
    default:
      return "nothing";
  }
}

void YamlValue::fail(const std::string& accepted, const std::string& to_do) const {
  fail_found(found(), accepted, to_do);
}

void YamlValue::fail_found(const std::string& found, const std::string& accepted, const std::string& to_do) const {
  std::string message = fmt::format("{}: found {}; accepted: {}", where(), found, accepted);
  if (!to_do.empty()) message += "\n" + to_do;
  throw ar::InputError(message);
}

YamlValue YamlValue::child(const YAML::Node& node, const std::string& key) const {
  return {node, file_, key};
}

YamlMap::YamlMap(const YamlValue& value, const std::vector<std::string>& known, const std::vector<std::string>& not_yet)
    : value_(value) {
  if (!value.node_.IsMap()) value.fail("a map with the keys " + join_or(known));
  // yaml-cpp keeps both entries of a duplicate key in the list and answers with the first: look at all of them.
  std::vector<std::pair<std::string, int>> seen;
  for (const auto& entry : value.node_) {
    check_key(entry.first, known, not_yet);
    const std::string key = entry.first.Scalar();
    for (const auto& [name, line] : seen) {
      if (name != key) continue;
      value.child(entry.first, value.key_.empty() ? key : value.key_ + "." + key)
          .fail_found(fmt::format("the key a second time, first in line {}", line), "each key once");
    }
    seen.emplace_back(key, entry.first.Mark().line + 1);
  }
}

void YamlMap::check_key(const YAML::Node& key, const std::vector<std::string>& known,
                        const std::vector<std::string>& not_yet) const {
  const YamlValue here = value_.child(key, value_.key_);
  if (!key.IsScalar()) here.fail_found("a key that is not a word", join_or(known));
  const std::string& name = key.Scalar();
  for (const std::string& word : known) {
    if (word == name) return;
  }
  for (const std::string& word : not_yet) {
    if (word != name) continue;
    const YAML::Node content = value_.node_[name];
    if (content.IsSequence() && content.size() == 0) return;
    throw ar::InputError(fmt::format("{}: '{}' is not supported yet by this version\nremove it", here.where(), name));
  }
  const std::string meant = closest(name, known);
  here.fail_found(fmt::format("the unknown key '{}'", name), join_or(known),
                  meant.empty() ? "" : fmt::format("did you mean '{}'?", meant));
}

std::optional<YamlValue> YamlMap::find(const std::string& key) const {
  const YAML::Node node = value_.node_[key];
  if (!node.IsDefined()) return std::nullopt;
  return value_.child(node, value_.key_.empty() ? key : value_.key_ + "." + key);
}

YamlValue YamlMap::require(const std::string& key, const std::string& accepted) const {
  if (auto value = find(key)) return *value;
  value_.fail_found(fmt::format("no '{}'", key), fmt::format("{}: {}", key, accepted));
}

std::string YamlMap::exactly_one_of(const std::vector<std::string>& choices) const {
  std::vector<std::string> there;
  for (const std::string& choice : choices) {
    if (find(choice)) there.push_back(choice);
  }
  if (there.empty()) value_.fail_found("none of these keys", "exactly one of " + join_or(choices));
  if (there.size() > 1) {
    value_.fail_found(fmt::format("'{}' and '{}' together", there[0], there[1]), "exactly one of " + join_or(choices));
  }
  return there.front();
}

double YamlMap::number_or(const std::string& key, double otherwise, const std::string& accepted,
                          const std::function<bool(double)>& legal) const {
  const auto value = find(key);
  return value ? value->number(accepted, legal) : otherwise;
}

}  // namespace app
