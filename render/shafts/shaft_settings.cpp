#include "render/shafts/shaft_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace render {
namespace {

std::string names_of_techniques() {
  std::vector<std::string> names{"auto"};
  for (const ShaftTechniqueInfo& info : shaft_techniques()) names.push_back(info.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string knobs_of(const ShaftTechniqueInfo& info) {
  std::vector<std::string> words;
  for (const ShaftKnob& knob : info.knobs) words.push_back(fmt::format("{}= ({})", knob.name, knob.accepted()));
  return words.empty() ? "no settings" : fmt::format("{}", fmt::join(words, ", "));
}

double read_value(const ShaftKnob& knob, const std::string& text) {
  if (!knob.choices.empty()) {
    const auto found = std::ranges::find(knob.choices, text);
    if (found != knob.choices.end()) return static_cast<double>(found - knob.choices.begin());
  } else {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool read = error == std::errc() && end == text.data() + text.size();
    if (read && value >= knob.low && value <= knob.high && (!knob.whole || value == std::floor(value))) return value;
  }
  throw std::invalid_argument(fmt::format("{}: found '{}'; accepted: {}", knob.name, text, knob.accepted()));
}

void read_setting(const ShaftTechniqueInfo& info, const std::string& text, ShaftSettings& settings) {
  const auto equals = text.find('=');
  const std::string key = text.substr(0, equals);
  const ShaftKnob* knob = info.find(key);
  if (knob == nullptr) {
    throw std::invalid_argument(
        fmt::format("{}: found the setting '{}'; accepted: {}", info.name, text, knobs_of(info)));
  }
  const double value = read_value(*knob, equals == std::string::npos ? "" : text.substr(equals + 1));
  if (!settings.knobs.emplace(key, value).second) {
    throw std::invalid_argument(fmt::format("{}: found '{}' twice; accepted: each setting once", info.name, key));
  }
}

}  // namespace

std::string ShaftKnob::accepted() const {
  if (!choices.empty()) return fmt::format("{}", fmt::join(choices, " or "));
  return fmt::format("{} from {:g} to {:g}", whole ? "a whole number" : "a number", low, high);
}

const ShaftKnob* ShaftTechniqueInfo::find(std::string_view knob) const {
  const auto found = std::ranges::find(knobs, knob, &ShaftKnob::name);
  return found == knobs.end() ? nullptr : &*found;
}

const ShaftTechniqueInfo* find_shaft_technique(std::string_view name) {
  const auto found = std::ranges::find(shaft_techniques(), name, &ShaftTechniqueInfo::name);
  return found == shaft_techniques().end() ? nullptr : &*found;
}

double ShaftSettings::number(std::string_view knob) const {
  if (const auto found = knobs.find(knob); found != knobs.end()) return found->second;
  const ShaftTechniqueInfo* info = find_shaft_technique(technique);
  const ShaftKnob* known = info == nullptr ? nullptr : info->find(knob);
  if (known == nullptr) throw std::logic_error(fmt::format("shafts: {} has no setting '{}'", technique, knob));
  return known->standard;
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
  for (const auto& [name, value] : settings.knobs) {
    const ShaftKnob* knob = info == nullptr ? nullptr : info->find(name);
    const bool choice = knob != nullptr && !knob->choices.empty();
    text += choice ? fmt::format("{}{}={}", separator, name, knob->choices.at(static_cast<std::size_t>(value)))
                   : fmt::format("{}{}={:g}", separator, name, value);
    separator = ',';
  }
  return text;
}

}  // namespace render
