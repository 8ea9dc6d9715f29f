#pragma once

#include <string>

#include "render/shafts/shaft_settings.h"

namespace app {

// "auto", "march", "march:steps=128,divisor=1": how --shafts and the scene's quality.shafts choose the light shafts'
// technique. Throws UsageError "WHERE: found X; accepted: Y", `where` naming the option or key.
render::ShaftSettings parse_shafts(const std::string& where, const std::string& text);

// What --help says of it: each technique with its settings.
std::string shafts_help();

}  // namespace app
