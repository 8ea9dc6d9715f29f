#pragma once

#include "render/sun/sun.h"

namespace render {

// Illuminance in lux of level ground under a clear sky with the sun's centre at that geometric elevation, sun and sky
// together (US Naval Observatory Circular 171, Janiczek & DeYoung 1987). The circular's pieces are blended over a
// degree where they meet. Below -18 degrees it falls on at the rate it has there: moon, airglow and stars take over.
double clear_illuminance_lux(double sun_elevation_rad);

// Illuminance of level ground from the moon, seen at that elevation and with `phase_angle_rad` between sun and earth
// (0 full, pi new), from the same circular. 0 below the horizon, fading in over the first degree around it.
double moon_illuminance_lux(double moon_elevation_rad, double phase_angle_rad, double distance_m);

// Diffuse illuminance in lux that a sky should give level ground: `model_lux`, a model's own value for this sun, by
// day; below 15 degrees more and more what clear_illuminance_lux() leaves for the sky; in twilight all of it.
// `model_lux` is taken as the value for the sun on the horizon once the sun has set.
double diffuse_level_lux(double model_lux, const SunPosition& sun, double turbidity);

// How much darker the sky is than with the sun on the horizon: 1 by day, clear_illuminance_lux() relative to its value
// at elevation 0 in twilight.
double twilight_dimming(double sun_elevation_rad);

}  // namespace render
