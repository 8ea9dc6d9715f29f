#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/scene_file/yaml_value.h"

namespace app {

struct MapShape;

// The numbers that are accepted; a bound that is absent does not bind. Numbers are always finite.
struct Range {
  std::optional<double> least = std::nullopt;
  std::optional<double> most = std::nullopt;
  bool least_excluded = false;
  bool most_excluded = false;

  bool holds(double x) const;
};

// "from 0 to 1", "above 0 and below 180", "0 or above", "any"; "1" where only one number is accepted.
std::string in_words(const Range& range);

enum class ValueKind { Number, Integer, Boolean, Word, Text, Numbers, Corners, Map, List };

// What may stand at a key of a YAML file: the parser checks by it, messages, documents and the schema describe it.
struct ValueShape {
  ValueKind kind = ValueKind::Text;
  std::string unit = {};                // of a number, in words; empty for a plain number
  Range range = {};                     // of a number, and of each of several
  std::string note = {};                // what else there is to say of the accepted values
  std::string form = {};                // how it is written, "[east, north, up]"; of a text or a word what is accepted
  std::size_t count = 0;                // of Numbers: how many
  std::vector<std::string> words = {};  // of Word: all that can be listed
  std::string pattern = {};             // of Word: ECMAScript expression of those that cannot be listed
  const MapShape* map = nullptr;        // of Map, and of List: of each entry; lives as long as the program
};

namespace shapes {

ValueShape number_in(Range range, std::string unit = "", std::string note = "");
// Within what single precision can compute with: magnitudes of at most 1e9, and of at least 1e-9 where 0 is not
// accepted.
ValueShape any_number(std::string unit, std::string note = "");
ValueShape number_above_0(std::string unit);
ValueShape number_from_0(std::string unit, std::string note = "");
ValueShape number_from_to(double least, double most, std::string unit = "", std::string note = "");
ValueShape share();           // from 0 to 1
ValueShape heading();         // degrees clockwise from north
ValueShape world_position();  // [east, north, up] in metres
ValueShape integer_from_to(int least, int most);
ValueShape boolean();
ValueShape one_word_of(std::vector<std::string> words);
ValueShape text(std::string accepted);
ValueShape numbers(std::size_t count, std::string form, std::string unit = "", Range each = {}, std::string note = "");
ValueShape corners();  // two opposite corners of a box
ValueShape map_of(const MapShape& map);
ValueShape list_of(const MapShape& entry);

}  // namespace shapes

// The accepted values in words, as messages and documents say it: "metres from -500 to 100000".
std::string accepted(const ValueShape& shape);

// The value, checked by its shape. Each throws ar::InputError that names file, line, key, what was found and what is
// accepted.
double read_number(const YamlValue& value, const ValueShape& shape);
std::vector<double> read_numbers(const YamlValue& value, const ValueShape& shape);
glm::dvec3 read_vector(const YamlValue& value, const ValueShape& shape);  // of Numbers, three of them

}  // namespace app
