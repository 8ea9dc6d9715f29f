#pragma once

#include <glm/vec3.hpp>

#include "render/sun/place_time.h"

namespace render {

// How the sun's place is computed (docs/sky.md, "The sun").
enum class SunTier { Daily, Psa, Precise };

// The air that refracts: pressure at the place and temperature.
struct Weather {
  double pressure_hpa = 1010.0;
  double temperature_c = 10.0;
};

// Topocentric place of the sun's centre.
struct SunPosition {
  double azimuth_rad = 0.0;             // from true north, clockwise, [0, 2 pi)
  double elevation_rad = 0.0;           // geometric, without air
  double apparent_elevation_rad = 0.0;  // with refraction; equals elevation_rad where refraction has faded out
  double distance_au = 1.0;
  double angular_radius_rad = 0.00465;

  // Unit vector towards the sun in the world (east, north, up), geometric and apparent.
  glm::dvec3 direction_in_world() const;
  glm::dvec3 apparent_direction_in_world() const;
};

// Where the sun stands seen from `place` at `time`. Finite for every finite input.
SunPosition sun_position(const Place& place, UtcTime time, SunTier tier = SunTier::Precise,
                         const Weather& weather = {});

// Linke turbidity of a clear sky: what lighting simulation takes where nothing is said, near the European mean
// (Radiance's gensky).
inline constexpr double kClearTurbidity = 2.45;

// What of the sun's light arrives at the ground.
struct SunLight {
  glm::dvec3 illuminance_rgb{0.0};     // lux on a plane that faces the sun, Rec. 709 linear; 0 when the disc is down
  double visible_disc_fraction = 0.0;  // of its area
  // Radius of an even disc that casts penumbrae as wide as the sun's, whose limb is dark: for soft shadows.
  double shadow_radius_rad = 0.0;
};

// Direct light after the atmosphere: Rayleigh, aerosol by `turbidity` (as Preetham 1999 appendix A.1 uses it), ozone,
// water vapour and mixed gases, times the share of the disc's light above the horizon (limb_darkening.h).
SunLight sun_light(const SunPosition& sun, double turbidity, double height_m = 0.0);

}  // namespace render
