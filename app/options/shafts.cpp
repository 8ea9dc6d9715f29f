#include "app/options/shafts.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "app/error.h"
#include "app/options/words.h"

namespace app {

render::ShaftSettings parse_shafts(const std::string& where, const std::string& text) {
  try {
    return render::parse_shaft_settings(text);
  } catch (const std::invalid_argument& error) {
    std::vector<std::string> names{"auto"};
    for (const render::ShaftTechniqueInfo& info : render::shaft_techniques()) names.push_back(info.name);
    const std::string name = text.substr(0, text.find(':'));
    const std::string meant = render::find_shaft_technique(name) == nullptr ? closest(name, names) : "";
    throw UsageError(
        fmt::format("{}: {}{}", where, error.what(), meant.empty() ? "" : "\ndid you mean '" + meant + "'?"));
  }
}

std::string shafts_help() {
  std::string text = "Light shafts: auto or NAME[:setting=value,...], with NAME of";
  for (const render::ShaftTechniqueInfo& info : render::shaft_techniques()) {
    text += fmt::format("\n{}: {}", info.name, info.summary);
    for (const render::ShaftParameter& parameter : info.parameters)
      text += fmt::format("\n  {}= {}; {}", parameter.name, parameter.meaning, parameter.accepted());
  }
  return text + "\nDefault: the scene's quality.shafts";
}

}  // namespace app
