#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/base/check.h"
#include "render/sun/air_mass.h"
#include "render/sun/limb_darkening.h"
#include "render/sun/spectrum.h"
#include "render/sun/sun.h"

namespace render {
namespace {

constexpr double kScaleHeightM = 8434.5;
constexpr double kOzoneCm = 0.35;  // Preetham 1999, A.1
constexpr double kWaterVapourCm = 2.0;

// Absorption coefficients of ozone and water vapour (1/cm) and mixed gases at the spectrum's wavelengths (Preetham
// 1999, table 2).
constexpr Spectrum kOzone = {0.0,   0.0,   0.0,   0.0,   0.0,   0.0,   0.0,   0.003, 0.006, 0.009, 0.014,
                             0.021, 0.030, 0.040, 0.048, 0.063, 0.075, 0.085, 0.103, 0.120, 0.120, 0.115,
                             0.125, 0.120, 0.105, 0.090, 0.079, 0.067, 0.057, 0.048, 0.036, 0.028, 0.023,
                             0.018, 0.014, 0.011, 0.010, 0.009, 0.007, 0.004, 0.0};
constexpr Spectrum kWaterVapour = {0.0, 0.0, 0.0, 0.0,   0.0,   0.0,    0.0, 0.0,  0.0,   0.0,   0.0,  0.0,  0.0, 0.0,
                                   0.0, 0.0, 0.0, 0.0,   0.0,   0.0,    0.0, 0.0,  0.0,   0.0,   0.0,  0.0,  0.0, 0.0,
                                   0.0, 0.0, 0.0, 0.016, 0.024, 0.0125, 1.0, 0.87, 0.061, 0.001, 1e-5, 1e-5, 6e-4};

// Preetham 1999, A.1: the product of the transmittances along air mass m.
double transmittance(int sample, double air_mass, double turbidity) {
  const auto i = static_cast<std::size_t>(sample);
  const double um = wavelength_nm(sample) * 1e-3;
  const double beta = std::max(0.04608365822050 * turbidity - 0.04586025928522, 0.0);
  const double rayleigh = 0.008735 * std::pow(um, -4.08) * air_mass;
  const double aerosol = beta * std::pow(um, -1.3) * air_mass;
  const double ozone = kOzone[i] * kOzoneCm * air_mass;
  const double gas = sample == 38 ? 3.0 : 0.0;  // the oxygen A band: 760 nm alone
  const double mixed_gases = 1.41 * gas * air_mass / std::pow(1.0 + 118.93 * gas * air_mass, 0.45);
  const double vapour = kWaterVapour[i] * kWaterVapourCm * air_mass;
  const double water = 0.2385 * vapour / std::pow(1.0 + 20.07 * vapour, 0.45);
  return std::exp(-(rayleigh + aerosol + ozone + mixed_gases + water));
}

// Area of the disc above a straight horizon at elevation 0, as a fraction.
double disc_fraction(double apparent_elevation_rad, double angular_radius_rad) {
  const double x = std::clamp(apparent_elevation_rad / angular_radius_rad, -1.0, 1.0);
  return 0.5 + (std::asin(x) + x * std::sqrt(1.0 - x * x)) / std::numbers::pi;
}

}  // namespace

SunLight sun_light(const SunPosition& sun, double turbidity, double height_m) {
  CHECK(turbidity > 0.0);
  CHECK(sun.distance_au > 0.0);
  CHECK(sun.angular_radius_rad > 0.0);
  CHECK(std::isfinite(height_m));
  SunLight light;
  light.shadow_radius_rad = even_disc_radius() * sun.angular_radius_rad;
  light.visible_disc_fraction = disc_fraction(sun.apparent_elevation_rad, sun.angular_radius_rad);
  if (light.visible_disc_fraction <= 0.0) return light;
  const double air_mass = relative_air_mass(sun.apparent_elevation_rad) * std::exp(-height_m / kScaleHeightM);
  const double nearness = 1.0 / (sun.distance_au * sun.distance_au);
  const double height = sun.apparent_elevation_rad / sun.angular_radius_rad;  // of the disc's middle, in radii
  Spectrum spectrum = extraterrestrial_irradiance();
  for (int i = 0; i < kSpectrumSamples; ++i) {
    spectrum[static_cast<std::size_t>(i)] *=
        nearness * visible_light_share(height, wavelength_nm(i)) * transmittance(i, air_mass, turbidity);
  }
  light.illuminance_rgb = clip_to_gamut(rgb_from_xyz(xyz_from_spectrum(spectrum)));
  return light;
}

}  // namespace render
