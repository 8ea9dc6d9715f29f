#include "render/shafts/shaft_technique.h"

#include <fmt/format.h>

#include <stdexcept>

#include "render/shafts/translucent_tint.h"

namespace render {

std::unique_ptr<ShaftTechnique> make_shaft_technique(const ShaftSettings& settings) {
  const ShaftTechniqueInfo* info = find_shaft_technique(settings.technique);
  if (info == nullptr) throw std::runtime_error(fmt::format("unknown shaft technique '{}'", settings.technique));
  std::unique_ptr<ShaftTechnique> technique = info->make(settings);
  if (info->handles_translucency) return technique;
  return std::make_unique<TranslucentTint>(std::move(technique));
}

}  // namespace render
