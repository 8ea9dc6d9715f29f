#include "render/shafts/shaft_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "render/base/number.h"

namespace render {
namespace {

std::string names_of_techniques() {
  std::vector<std::string> names{"auto"};
  for (const ShaftTechniqueInfo& info : shaft_techniques()) names.push_back(info.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string parameters_of(const ShaftTechniqueInfo& info) {
  std::vector<std::string> words;
  for (const ShaftParameter& parameter : info.parameters)
    words.push_back(fmt::format("{}= ({})", parameter.name, parameter.accepted()));
  return words.empty() ? "no settings" : fmt::format("{}", fmt::join(words, ", "));
}

double read_value(const ShaftParameter& parameter, const std::string& text) {
  if (!parameter.choices.empty()) {
    const auto found = std::ranges::find(parameter.choices, text);
    if (found != parameter.choices.end()) return static_cast<double>(found - parameter.choices.begin());
  } else {
    const std::optional<double> value = parse_number(text);
    const bool within = value && *value >= parameter.low && *value <= parameter.high;
    if (within && (!parameter.integer || *value == std::floor(*value))) return *value;
  }
  throw std::invalid_argument(fmt::format("{}: found '{}'; accepted: {}", parameter.name, text, parameter.accepted()));
}

void read_setting(const ShaftTechniqueInfo& info, const std::string& text, ShaftSettings& settings) {
  const auto equals = text.find('=');
  const std::string key = text.substr(0, equals);
  const ShaftParameter* parameter = info.find(key);
  if (parameter == nullptr) {
    throw std::invalid_argument(
        fmt::format("{}: found the setting '{}'; accepted: {}", info.name, text, parameters_of(info)));
  }
  const double value = read_value(*parameter, equals == std::string::npos ? "" : text.substr(equals + 1));
  if (!settings.parameters.emplace(key, value).second) {
    throw std::invalid_argument(fmt::format("{}: found '{}' twice; accepted: each setting once", info.name, key));
  }
}

}  // namespace

std::string ShaftParameter::accepted() const {
  if (!choices.empty()) return fmt::format("{}", fmt::join(choices, " or "));
  return fmt::format("{} from {:g} to {:g}", integer ? "a whole number" : "a number", low, high);
}

const ShaftParameter* ShaftTechniqueInfo::find(std::string_view parameter) const {
  const auto found = std::ranges::find(parameters, parameter, &ShaftParameter::name);
  return found == parameters.end() ? nullptr : &*found;
}

const ShaftTechniqueInfo* find_shaft_technique(std::string_view name) {
  const auto found = std::ranges::find(shaft_techniques(), name, &ShaftTechniqueInfo::name);
  return found == shaft_techniques().end() ? nullptr : &*found;
}

double ShaftSettings::number(std::string_view parameter) const {
  if (const auto found = parameters.find(parameter); found != parameters.end()) return found->second;
  const ShaftTechniqueInfo* info = find_shaft_technique(technique);
  const ShaftParameter* known = info == nullptr ? nullptr : info->find(parameter);
  if (known == nullptr) throw std::logic_error(fmt::format("shafts: {} has no setting '{}'", technique, parameter));
  return known->default_value;
}

ShaftSettings parse_shaft_settings(const std::string& text) {
  const auto colon = text.find(':');
  ShaftSettings settings{.technique = text.substr(0, colon)};
  const ShaftTechniqueInfo* info = find_shaft_technique(settings.technique);
  if (info == nullptr && settings.technique != "auto") {
    throw std::invalid_argument(fmt::format("found '{}'; accepted: {}", settings.technique, names_of_techniques()));
  }
  if (colon == std::string::npos) return settings;
  if (info == nullptr) throw std::invalid_argument(fmt::format("found '{}'; accepted: auto takes no settings", text));
  std::istringstream all(text.substr(colon + 1));
  for (std::string setting; std::getline(all, setting, ',');) read_setting(*info, setting, settings);
  return settings;
}

std::string to_text(const ShaftSettings& settings) {
  std::string text = settings.technique;
  const ShaftTechniqueInfo* info = find_shaft_technique(settings.technique);
  char separator = ':';
  for (const auto& [name, value] : settings.parameters) {
    const ShaftParameter* parameter = info == nullptr ? nullptr : info->find(name);
    const bool choice = parameter != nullptr && !parameter->choices.empty();
    text += choice ? fmt::format("{}{}={}", separator, name, parameter->choices.at(static_cast<std::size_t>(value)))
                   : fmt::format("{}{}={:g}", separator, name, value);
    separator = ',';
  }
  return text;
}

}  // namespace render
