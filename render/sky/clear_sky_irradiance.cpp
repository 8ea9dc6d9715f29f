#include "render/sky/clear_sky_irradiance.h"

#include <algorithm>
#include <cmath>

#include "render/sun/air_mass.h"

namespace render {

ClearSkyIrradiance clear_sky_irradiance(double linke_turbidity, double sun_elevation_rad, double height_m,
                                        double extraterrestrial_normal_wm2) {
  const double turbidity = std::clamp(linke_turbidity, 1.0, 20.0);
  const double sine = std::sin(std::max(sun_elevation_rad, 0.0));
  const double air_mass = relative_air_mass(sun_elevation_rad) * std::exp(-height_m / 8434.5);

  const double fh1 = std::exp(-height_m / 8000.0);
  const double fh2 = std::exp(-height_m / 1250.0);
  const double cg1 = 5.09e-5 * height_m + 0.868;
  const double cg2 = 3.92e-5 * height_m + 0.0387;
  // The correction exp(0.01 m^1.8) was fitted to high sun and grows without bounds towards the horizon: its air mass
  // bends smoothly to 5.
  const double held_air_mass = air_mass * std::pow(1.0 + std::pow(air_mass / 5.0, 6.0), -1.0 / 6.0);
  const double enhancement = std::exp(0.01 * std::pow(held_air_mass, 1.8));
  const double global = cg1 * extraterrestrial_normal_wm2 * sine * enhancement *
                        std::exp(-cg2 * air_mass * (fh1 + fh2 * (turbidity - 1.0)));
  const double beam =
      extraterrestrial_normal_wm2 * (0.664 + 0.163 / fh1) * std::exp(-0.09 * air_mass * (turbidity - 1.0));
  const double diffuse_share = std::clamp((0.1 - 0.2 * std::exp(-turbidity)) / (0.1 + 0.882 / fh1), 0.0, 1.0);
  const double direct_horizontal = std::min(beam * sine, global * (1.0 - diffuse_share));
  return {sine > 0.0 ? direct_horizontal / sine : 0.0, global - direct_horizontal};
}

}  // namespace render
