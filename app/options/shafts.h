#pragma once

#include <string>

#include "render/plan/plan.h"

namespace app {

// "auto", "closed-form", "march", "march:steps=128,divisor=1": how --shafts and the scene's quality.shafts choose the
// light shafts' technique. Throws UsageError "WHERE: found X; accepted: Y", `where` naming the option or key.
render::ShaftSettings parse_shafts(const std::string& where, const std::string& text);

}  // namespace app
