#pragma once

#include <glm/vec3.hpp>

#include "render/sun/sun.h"

namespace render {

// Topocentric place and phase of the moon.
struct MoonPosition {
  double azimuth_rad = 0.0;             // from true north, clockwise, [0, 2 pi)
  double elevation_rad = 0.0;           // geometric, with parallax, without air
  double apparent_elevation_rad = 0.0;  // with refraction
  double distance_m = 3.844e8;          // from the observer
  double phase_angle_rad = 0.0;         // between sun and observer seen from the moon: 0 full, pi new
  double illuminated_fraction = 1.0;

  glm::dvec3 apparent_direction_in_world() const;
};

// The moon seen from `place` (Meeus 1998 through ERFA, within 10 arc seconds; IAU 2006/2000A, UT1 = UTC).
MoonPosition moon_position(const Place& place, UtcTime time, const Weather& weather = {});

// Lux of a plane that faces the moon: the sun's light for the same elevation and air, in the proportion of full moon to
// sun by that phase (US Naval Observatory Circular 171). 0 below the horizon.
glm::dvec3 moon_illuminance_rgb(const MoonPosition& moon, double turbidity);

// How bright the moon is compared to the sun at the same place in the sky.
double moon_to_sun(const MoonPosition& moon);

// The moon's place as a sun's, for models that know the sun alone.
SunPosition as_sun(const MoonPosition& moon);

}  // namespace render
