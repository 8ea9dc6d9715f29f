#include <stdexcept>

#include "render/sky/perez_sky.h"
#include "render/sky/sky_model.h"

namespace render {
namespace {

class BlackSky final : public SkyModel {
 public:
  glm::dvec3 luminance_rgb(const glm::dvec3&) const override { return glm::dvec3(0.0); }
};

}  // namespace

std::unique_ptr<SkyModel> make_sky(const SkyOptions& options, const SunPosition& sun) {
  if (options.model == "none") return std::make_unique<BlackSky>();
  if (options.model == "perez") return make_perez_sky(options.turbidity, sun);
  throw std::runtime_error("unknown sky model `" + options.model + "`\nknown models: perez, none");
}

}  // namespace render
