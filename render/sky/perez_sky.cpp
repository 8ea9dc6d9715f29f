#include "render/sky/perez_sky.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/sky/clear_sky_irradiance.h"
#include "render/sky/hemisphere.h"
#include "render/sky/perez.h"
#include "render/sky/preetham.h"
#include "render/sky/twilight.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr double kModelFloorRad = 3.0 * kRadPerDeg;       // Perez 1993 was fitted to sun zenith angles up to 87 degrees
constexpr double kTwilightCeilingRad = 5.0 * kRadPerDeg;  // below it the sky brightness says little (air mass > 10)

double smooth_step(double edge0, double edge1, double x) {
  const double t = std::clamp((x - edge0) / (edge1 - edge0), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// On the unit sphere; what lies below the horizon is moved up to it.
glm::dvec3 above_horizon(const glm::dvec3& direction) {
  glm::dvec3 unit = glm::normalize(direction);
  if (unit.z >= 0.0) return unit;
  const double horizontal = std::hypot(unit.x, unit.y);
  if (horizontal < 1e-12) return {0.0, 1.0, 0.0};
  return {unit.x / horizontal, unit.y / horizontal, 0.0};
}

class PerezSky final : public SkyModel {
 public:
  PerezSky(double turbidity, const SunPosition& sun)
      : sun_in_world_(above_horizon(sun.apparent_direction_in_world())),
        sun_elevation_rad_(sun.elevation_rad),
        colors_(preetham_shapes(turbidity)) {
    const double elevation = std::max(sun.elevation_rad, kModelFloorRad);
    const double zenith = std::numbers::pi / 2.0 - elevation;
    const double outside_wm2 = kSolarConstantWm2 / (sun.distance_au * sun.distance_au);
    const ClearSkyIrradiance clear = clear_sky_irradiance(turbidity, elevation, 0.0, outside_wm2);
    const double clearness = sky_clearness(clear.dni_wm2, clear.dhi_wm2, zenith);
    const double brightness = sky_brightness(clear.dhi_wm2, zenith, outside_wm2);
    shape_ = perez_shape(clearness, brightness, zenith);

    color_zenith_ = preetham_zenith(turbidity, zenith);
    const double gamma = zenith;
    color_zenith_.x /= perez_luminance(colors_.x, 1.0, gamma, std::cos(gamma));
    color_zenith_.y /= perez_luminance(colors_.y, 1.0, gamma, std::cos(gamma));
    scale_ = level_lux(clear.dhi_wm2 * diffuse_efficacy(clearness, brightness, zenith)) / relative_illuminance();
  }

  glm::dvec3 luminance_rgb(const glm::dvec3& direction_in_world) const override {
    const glm::dvec3 direction = above_horizon(direction_in_world);
    const double cos_gamma = std::clamp(glm::dot(direction, sun_in_world_), -1.0, 1.0);
    const double gamma = std::acos(cos_gamma);
    const double level = scale_ * std::max(perez_luminance(shape_, direction.z, gamma, cos_gamma), 0.0);
    double x = color_zenith_.x * perez_luminance(colors_.x, direction.z, gamma, cos_gamma);
    double y = color_zenith_.y * perez_luminance(colors_.y, direction.z, gamma, cos_gamma);
    // Twilight is bluer than any daylight: ozone takes the yellow out of light that crosses it on a slant.
    const double dusk = 1.0 - smooth_step(-6.0 * kRadPerDeg, 1.0 * kRadPerDeg, sun_elevation_rad_);
    x += dusk * (0.245 - x);
    y += dusk * (0.245 - y);
    return clip_to_gamut(rgb_from_xyz(xyz_from_yxy(level, x, y)));
  }

 private:
  // Diffuse horizontal illuminance: the model's by day, the measured one in twilight.
  double level_lux(double model_lux) const {
    const double day = smooth_step(0.0, kTwilightCeilingRad, sun_elevation_rad_);
    return std::exp(day * std::log(std::max(model_lux, 1.0)) +
                    (1.0 - day) * std::log(twilight_illuminance_lux(sun_elevation_rad_)));
  }

  double relative_illuminance() const {
    double sum = 0.0;
    for (const SolidAngleSample& sample : upper_hemisphere()) {
      const double cos_gamma = std::clamp(glm::dot(sample.direction_in_world, sun_in_world_), -1.0, 1.0);
      const double level = perez_luminance(shape_, sample.direction_in_world.z, std::acos(cos_gamma), cos_gamma);
      sum += std::max(level, 0.0) * sample.direction_in_world.z * sample.solid_angle_sr;
    }
    return sum;
  }

  glm::dvec3 sun_in_world_;
  double sun_elevation_rad_;
  PerezShape shape_;
  PreethamShapes colors_;
  PreethamZenith color_zenith_;
  double scale_ = 0.0;
};

}  // namespace

std::unique_ptr<SkyModel> make_perez_sky(double turbidity, const SunPosition& sun) {
  return std::make_unique<PerezSky>(turbidity, sun);
}

}  // namespace render
