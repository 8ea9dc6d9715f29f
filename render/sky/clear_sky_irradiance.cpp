#include "render/sky/clear_sky_irradiance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/sun/air_mass.h"

namespace render {

ClearSkyIrradiance clear_sky_irradiance(double linke_turbidity, double sun_elevation_rad, double height_m,
                                        double extraterrestrial_normal_wm2) {
  constexpr double kLowestRad = std::numbers::pi / 180.0;
  const double turbidity = std::clamp(linke_turbidity, 1.0, 20.0);
  const double elevation = std::max(sun_elevation_rad, kLowestRad);
  const double sin_elevation = std::sin(elevation);
  const double air_mass = relative_air_mass(elevation) * std::exp(-height_m / 8434.5);

  const double fh1 = std::exp(-height_m / 8000.0);
  const double fh2 = std::exp(-height_m / 1250.0);
  const double cg1 = 5.09e-5 * height_m + 0.868;
  const double cg2 = 3.92e-5 * height_m + 0.0387;
  const double global =
      cg1 * extraterrestrial_normal_wm2 * sin_elevation * std::exp(-cg2 * air_mass * (fh1 + fh2 * (turbidity - 1.0)));
  const double beam =
      extraterrestrial_normal_wm2 * (0.664 + 0.163 / fh1) * std::exp(-0.09 * air_mass * (turbidity - 1.0));
  const double beam_limit = global * (1.0 - (0.1 - 0.2 * std::exp(-turbidity)) / (0.1 + 0.882 / fh1)) / sin_elevation;
  const double direct = std::clamp(std::min(beam, beam_limit), 0.0, global / sin_elevation);
  return {direct, std::max(global - direct * sin_elevation, 0.0)};
}

}  // namespace render
