#include "render/sky/scattering_sky.h"

#include <algorithm>
#include <cmath>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/medium/medium.h"
#include "render/sky/atmosphere.h"
#include "render/sky/direction.h"
#include "render/sky/dusk_sky.h"
#include "render/sky/sky_condition.h"
#include "render/sky/sky_model_list.h"
#include "render/sky/twilight.h"
#include "render/sun/air_mass.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

constexpr double kScaleHeightM = 8400.0;
const glm::dvec3 kWavelengthsUm(0.650, 0.570, 0.475);  // Preetham 2002's choice for R, G, B
constexpr double kEccentricity = 0.76;                 // g of the Mie particles

class ScatteringSky final : public SkyModel {
 public:
  ScatteringSky(double turbidity, const SunPosition& sun) : sun_in_world_(daytime_sun_direction(sun)) {
    const double beta = Atmosphere::aerosol_depth_at_1um(turbidity);
    rayleigh_ = 0.008735 * glm::pow(kWavelengthsUm, glm::dvec3(-4.08)) / kScaleHeightM;
    // "an approximation which scales with 1 / lambda^2", with the same aerosol as the reference at 550 nm
    const double mie_at_550 = beta * std::pow(0.55, -1.3) / kScaleHeightM;
    mie_ = mie_at_550 * (0.55 * 0.55) / (kWavelengthsUm * kWavelengthsUm);
    const double sun_path_m = path_m(std::asin(std::clamp(sun_in_world_.z, 0.0, 1.0)));
    const glm::dvec3 outside = rgb_from_xyz(xyz_from_spectrum(extraterrestrial_irradiance()));
    // "a scalar factor which represents the energy of the sun": what of it arrives, without its colour
    sun_lux_ = luminance(outside * glm::exp(-(rayleigh_ + mie_) * sun_path_m)) / (sun.distance_au * sun.distance_au);
  }

  glm::dvec3 luminance_rgb(const glm::dvec3& direction_in_world) const override {
    const glm::dvec3 view = above_horizon(direction_in_world);
    const double cosine = angle_between(view, sun_in_world_).cosine;
    const glm::dvec3 extinction = rayleigh_ + mie_;
    const glm::dvec3 scattered = rayleigh_ * phase(PhaseFunction::Rayleigh, 0.0, cosine) +
                                 mie_ * phase(PhaseFunction::HenyeyGreenstein, kEccentricity, cosine);
    const double path = path_m(std::asin(std::clamp(view.z, 0.0, 1.0)));
    return sun_lux_ * scattered / extinction * (1.0 - glm::exp(-extinction * path));  // Yang 2007, eq. 5
  }

 private:
  static double path_m(double elevation_rad) { return kScaleHeightM * relative_air_mass(elevation_rad); }

  glm::dvec3 sun_in_world_;
  glm::dvec3 rayleigh_;  // 1/m
  glm::dvec3 mie_;
  double sun_lux_;
};

std::unique_ptr<SkyModel> scattering(const SkyOptions& options, const SunPosition& sun) {
  const Day day = day_of(sun);
  const double level = diffuse_level_lux(clear_condition(options, day).diffuse_lux, sun, options.turbidity);
  return make_dusk_sky(make_scattering_sky(options.turbidity, day.sun), sun, options.turbidity, level, kClearHandover,
                       1.0);
}

}  // namespace

std::unique_ptr<SkyModel> make_scattering_sky(double turbidity, const SunPosition& sun) {
  return std::make_unique<ScatteringSky>(turbidity, sun);
}

SkyModelInfo scattering_model() {
  return {.written = "scattering",
          .words = {"scattering"},
          .summary =
              "Hoffman & Preetham 2002 as in Yang 2007, equations 2-8: one scattering, three wavelengths, scaled "
              "to the clear-sky level.",
          .make = scattering};
}

}  // namespace render
