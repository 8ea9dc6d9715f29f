#pragma once

#include <string>

#include "render/plan/plan.h"

namespace app {

// "auto", "closed-form", "march", "march:steps=128,divisor=1": how --shafts and the scene's quality.shafts choose the
// light shafts' technique. Throws UsageError that says what was found and accepted.
render::ShaftSettings parse_shafts(const std::string& text);

}  // namespace app
