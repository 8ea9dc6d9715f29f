#include "render/sky/dusk_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "render/sky/hemisphere.h"
#include "render/sky/reference_sky.h"
#include "render/sky/smooth_step.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

// Below this elevation the light is left to the level: the shape of the last glow is kept, for scattering computed
// with so little light is noise.
constexpr double kLowestShapeRad = -12.0 * std::numbers::pi / 180.0;

class DuskSky final : public SkyModel {
 public:
  DuskSky(std::unique_ptr<SkyModel> day, double day_scale, std::unique_ptr<SkyModel> twilight, double twilight_scale)
      : day_(std::move(day)), twilight_(std::move(twilight)), day_scale_(day_scale), twilight_scale_(twilight_scale) {}

  glm::dvec3 luminance_rgb(const glm::dvec3& direction_in_world) const override {
    glm::dvec3 sum(0.0);
    if (day_scale_ > 0.0) sum += day_scale_ * day_->luminance_rgb(direction_in_world);
    if (twilight_scale_ > 0.0) sum += twilight_scale_ * twilight_->luminance_rgb(direction_in_world);
    return sum;
  }

  glm::dvec3 luminance_xyz(const glm::dvec3& direction_in_world) const override {
    glm::dvec3 sum(0.0);
    if (day_scale_ > 0.0) sum += day_scale_ * day_->luminance_xyz(direction_in_world);
    if (twilight_scale_ > 0.0) sum += twilight_scale_ * twilight_->luminance_xyz(direction_in_world);
    return sum;
  }

 private:
  std::unique_ptr<SkyModel> day_;
  std::unique_ptr<SkyModel> twilight_;
  double day_scale_;
  double twilight_scale_;
};

double scale_to(const SkyModel& sky, double level_lux) {
  const double own_lux = luminance(horizontal_illuminance(sky));
  return own_lux > 0.0 ? level_lux / own_lux : 0.0;
}

}  // namespace

std::unique_ptr<SkyModel> make_dusk_sky(std::unique_ptr<SkyModel> day, const SunPosition& sun, double turbidity,
                                        double level_lux, const Handover& handover, double clearness) {
  const double risen = smooth_step(handover.twilight_below_rad, handover.day_from_rad, sun.elevation_rad);
  const double twilight_share = (1.0 - risen) * clearness;
  const double day_scale = (1.0 - twilight_share) * scale_to(*day, level_lux);
  if (twilight_share <= 0.0) return std::make_unique<DuskSky>(std::move(day), day_scale, nullptr, 0.0);

  SunPosition low = sun;
  low.elevation_rad = std::max(sun.elevation_rad, kLowestShapeRad);
  low.apparent_elevation_rad = std::max(sun.apparent_elevation_rad, kLowestShapeRad);
  auto twilight = make_reference_sky(turbidity, low);
  const double twilight_scale = twilight_share * scale_to(*twilight, level_lux);
  return std::make_unique<DuskSky>(std::move(day), day_scale, std::move(twilight), twilight_scale);
}

}  // namespace render
