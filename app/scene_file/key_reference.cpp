// The key reference of docs/scene-file.md.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "app/options/words.h"
#include "app/scene_file/key_documents.h"
#include "app/scene_file/scene_keys.h"
#include "render/sky/sky_models.h"

namespace app {
namespace {

const char* const kHeading = "## Keys\n";

std::string type_words(const ValueShape& shape) {
  switch (shape.kind) {
    case ValueKind::Number:
      return "number";
    case ValueKind::Integer:
      return "whole number";
    case ValueKind::Boolean:
      return "boolean";
    case ValueKind::Word:
      return "word";
    case ValueKind::Text:
      return "text";
    case ValueKind::Numbers:
      return fmt::format("{} numbers", shape.count);
    case ValueKind::Corners:
      return "2 × 3 numbers";
    case ValueKind::Map:
      return "map";
    case ValueKind::List:
      return "list of maps";
  }
  return "";
}

std::string range_words(const ValueShape& shape) {
  std::string words = shape.form;
  if (shape.kind == ValueKind::Word && words.empty()) words = join_or(shape.words);
  if (shape.kind == ValueKind::Boolean) words = "true or false";
  if (shape.range.least || shape.range.most || shape.kind == ValueKind::Number) {
    words += (words.empty() ? "" : ", each ") + in_words(shape.range);
  }
  if (!shape.note.empty()) words += (words.empty() ? "" : "; ") + shape.note;
  return words;
}

std::string default_words(const MapShape& map, const KeyShape& key) {
  for (const std::string& choice : map.exactly_one_of) {
    if (choice == key.name) return "one of " + join_or(map.exactly_one_of);
  }
  if (key.required) return "required";
  std::string words = key.default_text;
  if (!key.only_with.empty()) words += (words.empty() ? "" : "; ") + ("only with " + join_or(key.only_with));
  return words;
}

// "|" would end a cell.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

bool has_own_section(const KeyShape& key) {
  return key.value.map != nullptr;
}

void write_rows(const MapShape& map, std::string& out) {
  out += "| key | type | unit | accepted | default | meaning | example |\n|---|---|---|---|---|---|---|\n";
  for (const KeyShape& key : map.keys) {
    const std::string example = has_own_section(key) ? "below" : fmt::format("`{}: {}`", key.name, key.example);
    out +=
        fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", key.name, type_words(key.value), cell(key.value.unit),
                    cell(range_words(key.value)), cell(default_words(map, key)), cell(key.meaning), cell(example));
  }
  if (!map.not_yet.empty()) {
    out += fmt::format("\n{} belong to the format, too, but do nothing yet: only an empty list may stand there.\n",
                       "`" + fmt::format("{}", fmt::join(map.not_yet, "` and `")) + "`");
  }
}

void write_map(const MapShape& map, const std::string& path, std::string& out) {
  for (const KeyShape& key : map.keys) {
    if (!has_own_section(key)) continue;
    const bool is_list = key.value.kind == ValueKind::List;
    const std::string name = path + key.name;
    out += fmt::format("\n### `{}`{}\n\n{}\n\n", name, is_list ? ", each entry" : "", key.meaning);
    write_rows(*key.value.map, out);
    if (path.empty()) {
      out += fmt::format("\n```yaml\n{}:{}{}\n```\n", key.name, is_list ? "\n  - " : " ", key.value.map->example);
    }
    write_map(*key.value.map, name + (is_list ? "[]." : "."), out);
  }
}

void write_sky_models(std::string& out) {
  out +=
      "\n## Sky models\n\nThe words for `sky.model` and `--model`.\n\n| model | turbidity | what it is "
      "|\n|---|---|---|\n";
  for (const render::SkyModelInfo& model : render::sky_models()) {
    const std::string limits =
        model.turbidity ? fmt::format("{:g} to {:g}", model.turbidity->least, model.turbidity->most) : "any";
    out += fmt::format("| `{}` | {} | {} |\n", model.written, limits, cell(model.summary));
  }
  out += "\nA turbidity outside a model's range is held at its end, with a warning.\n";
}

}  // namespace

std::string scene_key_reference() {
  std::string out = kHeading;
  out += "\nWritten by `skyshaft-scene-docs` from the tables that the parser reads; edit those.\n\n";
  write_rows(scene_keys().shape(), out);
  write_map(scene_keys().shape(), "", out);
  out += "\n## Tag map files\n\nWhat `skyshaft map` writes and `tags.file` names.\n\n";
  write_rows(tag_map_file_keys().shape(), out);
  write_sky_models(out);
  return out;
}

std::string with_key_reference(const std::string& document) {
  const std::size_t at = document.find(kHeading);
  if (at == std::string::npos) throw std::runtime_error("the document has no heading '## Keys'");
  return document.substr(0, at) + scene_key_reference();
}

}  // namespace app
