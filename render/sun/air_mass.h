#pragma once

namespace render {

// Relative optical air mass at an elevation in radians (Kasten & Young 1989): 1 at the zenith, 38 at the horizon, held
// at the horizon's value below it.
double relative_air_mass(double elevation_rad);

}  // namespace render
