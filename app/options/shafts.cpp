#include "app/options/shafts.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <vector>

#include "app/error.h"
#include "app/words.h"

namespace app {
namespace {

const std::vector<std::string> kTechniques{"auto", "closed-form", "march"};

int parse_setting(const std::string& where, const std::string& key, const std::string& text, int maximum) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 1 || value > maximum) {
    throw UsageError(
        fmt::format("{}: {}: found '{}'; accepted: a whole number from 1 to {}", where, key, text, maximum));
  }
  return value;
}

void apply_setting(const std::string& where, const std::string& setting, render::ShaftSettings& shafts) {
  const auto equals = setting.find('=');
  const std::string key = setting.substr(0, equals);
  const std::string value = equals == std::string::npos ? "" : setting.substr(equals + 1);
  if (key == "steps") {
    shafts.steps = parse_setting(where, key, value, 4096);
  } else if (key == "divisor") {
    shafts.divisor = parse_setting(where, key, value, 8);
  } else {
    throw UsageError(fmt::format("{}: found the setting '{}'; accepted: steps=N or divisor=N", where, setting));
  }
}

}  // namespace

render::ShaftSettings parse_shafts(const std::string& where, const std::string& text) {
  const auto colon = text.find(':');
  render::ShaftSettings shafts;
  shafts.technique = text.substr(0, colon);
  if (std::find(kTechniques.begin(), kTechniques.end(), shafts.technique) == kTechniques.end()) {
    const std::string meant = closest(shafts.technique, kTechniques);
    throw UsageError(fmt::format("{}: found '{}'; accepted: {}{}", where, shafts.technique, join_or(kTechniques),
                                 meant.empty() ? "" : "\ndid you mean '" + meant + "'?"));
  }
  if (colon == std::string::npos) return shafts;
  std::istringstream settings(text.substr(colon + 1));
  for (std::string setting; std::getline(settings, setting, ',');) apply_setting(where, setting, shafts);
  return shafts;
}

}  // namespace app
