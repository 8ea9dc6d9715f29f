#pragma once

namespace render {

// Broadband irradiance on the ground under a sky without clouds.
struct ClearSkyIrradiance {
  double dni_wm2 = 0.0;  // direct, on a plane that faces the sun
  double dhi_wm2 = 0.0;  // diffuse, on the level
};

// Total irradiance outside the atmosphere at 1 au, W/m2 (Gueymard 2004).
inline constexpr double kSolarConstantWm2 = 1366.1;

// Clear-sky irradiance for Linke turbidity (Ineichen & Perez 2002, with the limit on direct light of Perez's program).
// sun_elevation_rad is held at or above 1 degree, turbidity in [1, 20], height in metres above the sea. Never negative.
ClearSkyIrradiance clear_sky_irradiance(double linke_turbidity, double sun_elevation_rad, double height_m,
                                        double extraterrestrial_normal_wm2);

}  // namespace render
