#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace render {

class ShaftTechnique;

// How the shafts are to be computed, as `--shafts NAME[:key=value,...]` says.
struct ShaftSettings {
  std::string technique = "auto";  // a name of shaft_techniques(), or "auto": the planner chooses
  std::map<std::string, double, std::less<>> parameters = {};  // those set by name; a choice counts from 0

  // The parameter's value: as set, else its standard one. Throws std::logic_error where the technique has no such
  // parameter.
  double number(std::string_view parameter) const;
  int integer(std::string_view parameter) const { return static_cast<int>(number(parameter)); }

  bool operator==(const ShaftSettings&) const = default;
};

// One thing that a technique can be set by: a number within [low, high], or one of `choices`.
struct ShaftParameter {
  std::string name;
  std::string meaning;  // for people, with the unit
  double low = 0.0;
  double high = 0.0;
  double default_value = 0.0;
  bool integer = false;
  std::vector<std::string> choices = {};

  std::string accepted() const;  // "a whole number from 1 to 8", "distance, depth or growing"
};

struct ShaftTechniqueInfo {
  std::string name;
  std::string summary;  // what it does and whose it is
  std::vector<ShaftParameter> parameters;
  std::vector<std::string> presets;  // settings from the cheapest to the most accurate, as parse_shaft_settings() reads
  std::unique_ptr<ShaftTechnique> (*make)(const ShaftSettings&);
  bool limited_by_shadow_resolution =
      false;  // its error is that of the shadow map's texels: the medium gets a finer one (CascadedShadow)
  bool handles_translucency = false;  // its pictures need no tint by translucent occluders (TranslucentTint)
  // Whether shafts soften with the distance from what casts them, by the sun's disc.
  bool (*soft_sun)(const ShaftSettings&) = [](const ShaftSettings&) { return false; };

  const ShaftParameter* find(std::string_view parameter) const;
};

// Every technique there is. `auto` is none of them.
const std::vector<ShaftTechniqueInfo>& shaft_techniques();
// For those that live in libraries of their own. Not while other threads look.
void add_shaft_technique(ShaftTechniqueInfo info);
const ShaftTechniqueInfo* find_shaft_technique(std::string_view name);

// "auto", "march", "march:steps=128,divisor=1". Throws std::invalid_argument "found X; accepted: Y".
ShaftSettings parse_shaft_settings(const std::string& text);

// The text that reads as these settings.
std::string to_text(const ShaftSettings& settings);

}  // namespace render
