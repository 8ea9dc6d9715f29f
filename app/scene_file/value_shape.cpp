#include "app/scene_file/value_shape.h"

#include <fmt/format.h>

#include <utility>

#include "app/options/words.h"
#include "app/scene_file/key_table.h"

namespace app {

bool Range::holds(double x) const {
  if (least && (x < *least || (least_excluded && x == *least))) return false;
  return !most || !(x > *most || (most_excluded && x == *most));
}

std::string in_words(const Range& range) {
  const auto number = [](double x) { return fmt::format("{:.10g}", x); };
  if (!range.least && !range.most) return "any";
  if (!range.most) return range.least_excluded ? "above " + number(*range.least) : number(*range.least) + " or above";
  if (!range.least) return range.most_excluded ? "below " + number(*range.most) : number(*range.most) + " or below";
  if (*range.least == *range.most) return number(*range.least);
  if (!range.least_excluded && !range.most_excluded) {
    return fmt::format("from {} to {}", number(*range.least), number(*range.most));
  }
  const std::string above = range.least_excluded ? "above " + number(*range.least) : "at least " + number(*range.least);
  const std::string below = range.most_excluded ? "below " + number(*range.most) : "at most " + number(*range.most);
  return above + (range.least_excluded && range.most_excluded ? " and " : ", ") + below;
}

namespace shapes {
namespace {

// Single precision on the GPU holds products and quotients of a few such numbers.
constexpr double kLargest = 1e9;
constexpr double kSmallest = 1e-9;

}  // namespace

ValueShape number_in(Range range, std::string unit, std::string note) {
  return {.kind = ValueKind::Number, .unit = std::move(unit), .range = range, .note = std::move(note)};
}

ValueShape any_number(std::string unit, std::string note) {
  return number_in({.least = -kLargest, .most = kLargest}, std::move(unit), std::move(note));
}

ValueShape number_above_0(std::string unit) {
  return number_in({.least = kSmallest, .most = kLargest}, std::move(unit));
}

ValueShape number_from_0(std::string unit, std::string note) {
  return number_in({.least = 0.0, .most = kLargest}, std::move(unit), std::move(note));
}

ValueShape number_from_to(double least, double most, std::string unit, std::string note) {
  return number_in({.least = least, .most = most}, std::move(unit), std::move(note));
}

ValueShape share() {
  return number_from_to(0.0, 1.0, "a share");
}

ValueShape heading() {
  return number_from_to(-360.0, 360.0, "degrees", "clockwise from north");
}

ValueShape world_position() {
  return numbers(3, "[east, north, up]", "metres", {.least = -kLargest, .most = kLargest});
}

ValueShape integer_from_to(int least, int most) {
  return {.kind = ValueKind::Integer, .range = {.least = least, .most = most}};
}

ValueShape boolean() {
  return {.kind = ValueKind::Boolean};
}

ValueShape one_word_of(std::vector<std::string> words) {
  return {.kind = ValueKind::Word, .words = std::move(words)};
}

ValueShape text(std::string accepted) {
  return {.kind = ValueKind::Text, .form = std::move(accepted)};
}

ValueShape numbers(std::size_t count, std::string form, std::string unit, Range each, std::string note) {
  return {.kind = ValueKind::Numbers,
          .unit = std::move(unit),
          .range = each,
          .note = std::move(note),
          .form = std::move(form),
          .count = count};
}

ValueShape corners() {
  return {.kind = ValueKind::Corners,
          .unit = "metres",
          .note = "the first below the second in every coordinate",
          .form = "two opposite corners [[west, south, low], [east, north, high]]"};
}

ValueShape map_of(const MapShape& map) {
  return {.kind = ValueKind::Map, .map = &map};
}

ValueShape list_of(const MapShape& entry) {
  return {.kind = ValueKind::List, .map = &entry};
}

}  // namespace shapes

namespace {

std::string accepted_numbers(const ValueShape& shape) {
  std::string words = shape.form;
  if (!shape.unit.empty()) words += " in " + shape.unit;
  if (shape.range.least || shape.range.most) words += ", each " + in_words(shape.range);
  return words;
}

std::string accepted_number(const ValueShape& shape) {
  const bool bound = shape.range.least || shape.range.most;
  if (bound && shape.range.least == shape.range.most) return in_words(shape.range);
  const std::string unit = shape.unit.empty() ? "a number" : shape.unit;
  return bound ? unit + " " + in_words(shape.range) : unit;
}

std::string accepted_without_note(const ValueShape& shape) {
  switch (shape.kind) {
    case ValueKind::Number:
      return accepted_number(shape);
    case ValueKind::Integer:
      return "a whole number " + in_words(shape.range);
    case ValueKind::Boolean:
      return "true or false";
    case ValueKind::Word:
      return shape.form.empty() ? join_or(shape.words) : shape.form;
    case ValueKind::Text:
      return shape.form;
    case ValueKind::Numbers:
    case ValueKind::Corners:
      return accepted_numbers(shape);
    case ValueKind::Map:
      return "a map with the keys " + join_or(shape.map->names());
    case ValueKind::List:
      return "a list of maps with the keys " + join_or(shape.map->names());
  }
  return "";
}

}  // namespace

std::string accepted(const ValueShape& shape) {
  const std::string words = accepted_without_note(shape);
  return shape.note.empty() ? words : words + "; " + shape.note;
}

double read_number(const YamlValue& value, const ValueShape& shape) {
  return value.number(accepted(shape), [&](double x) { return shape.range.holds(x); });
}

std::vector<double> read_numbers(const YamlValue& value, const ValueShape& shape) {
  if (!value.is_list()) value.fail(accepted(shape));
  const std::vector<YamlValue> items = value.list();
  if (items.size() != shape.count) value.fail(accepted(shape));
  std::vector<double> found;
  for (const YamlValue& item : items) {
    found.push_back(item.number("a finite number", [](double) { return true; }));
    if (!shape.range.holds(found.back())) item.fail(accepted(shape));
  }
  return found;
}

glm::dvec3 read_vector(const YamlValue& value, const ValueShape& shape) {
  const std::vector<double> found = read_numbers(value, shape);
  return {found.at(0), found.at(1), found.at(2)};
}

}  // namespace app
