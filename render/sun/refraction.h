#pragma once

#include "render/sun/sun.h"

namespace render {

// Elevation with refraction (Saemundsson 1986; Meeus, Astronomical Algorithms, 16.4) for a geometric elevation in
// [-pi/2, pi/2], radians. Below -1 degree the lift fades smoothly to nothing at -3.5 degrees, where nobody sees the
// sun; the result rises monotonically with the geometric elevation and never exceeds pi/2.
double apparent_elevation(double elevation_rad, const Weather& weather);

}  // namespace render
