#include "render/shafts/shaft_technique.h"

#include <fmt/format.h>

#include <stdexcept>

#include "render/shafts/closed_form.h"
#include "render/shafts/march.h"

namespace render {

std::unique_ptr<ShaftTechnique> make_shaft_technique(const ShaftSettings& settings) {
  if (settings.divisor < 1 || settings.steps < 1) {
    throw std::runtime_error(fmt::format("shafts need steps >= 1 and divisor >= 1, not steps {} and divisor {}",
                                         settings.steps, settings.divisor));
  }
  if (settings.technique == "closed-form") return std::make_unique<ClosedForm>(settings.divisor);
  if (settings.technique == "march") return std::make_unique<March>(settings.steps, settings.divisor);
  throw std::runtime_error(
      fmt::format("unknown shaft technique '{}': expected closed-form or march", settings.technique));
}

}  // namespace render
