#pragma once

namespace render {

// Broadband irradiance on the ground under a sky without clouds.
struct ClearSkyIrradiance {
  double dni_wm2 = 0.0;  // direct, on a plane that faces the sun
  double dhi_wm2 = 0.0;  // diffuse, on the level
};

// Total irradiance outside the atmosphere at 1 au, W/m2 (as Perez 1990 takes it).
inline constexpr double kSolarConstantWm2 = 1367.0;

// Clear-sky irradiance for Linke turbidity (Ineichen & Perez 2002, eq. 6-9, with Perez's correction for high sun and
// his limit on direct light). Turbidity is held in [1, 20], sun_elevation_rad at or above 0; height in metres above
// the sea. Never negative.
ClearSkyIrradiance clear_sky_irradiance(double linke_turbidity, double sun_elevation_rad, double height_m,
                                        double extraterrestrial_normal_wm2);

}  // namespace render
