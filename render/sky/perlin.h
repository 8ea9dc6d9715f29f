#pragma once

#include <cstdint>

namespace render {

// Improved Perlin noise in three dimensions (Perlin 2002), about [-1, 1], 0 at whole coordinates. The same for the same
// seed on every machine.
double perlin(double x, double y, double z, std::uint32_t seed);

// Octaves of it, each with twice the frequency and `persistence` times the amplitude of the one before (Yang 2007,
// section 3.2), divided by their common standard deviation. Octaves whose period is under `finest`, in units of the
// first octave's, would alias and are left out.
struct Octaves {
  double value = 0.0;
  double lost = 0.0;  // standard deviation of what was left out, [0, 1]
};
Octaves perlin_octaves(double x, double y, double z, int octaves, double persistence, double finest,
                       std::uint32_t seed);

}  // namespace render
