#pragma once

#include <cstdint>

namespace render {

// Improved Perlin noise in three dimensions (Perlin 2002), about [-1, 1], 0 at whole coordinates. The same for the same
// seed on every machine.
double perlin(double x, double y, double z, std::uint32_t seed);

// Octaves of it, each with twice the frequency and `persistence` times the amplitude of the one before (Yang 2007,
// section 3.2), divided by their common standard deviation. `finest` in (0, 1] is the smallest period of the first
// octave's that is still added: finer ones would alias.
double perlin_octaves(double x, double y, double z, int octaves, double persistence, double finest, std::uint32_t seed);

}  // namespace render
