#include "render/shafts/shaft_technique.h"

#include <fmt/format.h>

#include <stdexcept>

namespace render {

std::unique_ptr<ShaftTechnique> make_shaft_technique(const ShaftSettings& settings) {
  const ShaftTechniqueInfo* info = find_shaft_technique(settings.technique);
  if (info == nullptr) throw std::runtime_error(fmt::format("unknown shaft technique '{}'", settings.technique));
  return info->make(settings);
}

}  // namespace render
