#include "render/sky/perlin.h"

#include <algorithm>
#include <cmath>

namespace render {
namespace {

// A well mixed number for a lattice point (the finaliser of MurmurHash3).
std::uint32_t hash(std::int64_t x, std::int64_t y, std::int64_t z, std::uint32_t seed) {
  std::uint64_t h = seed * 0x9E3779B97F4A7C15ULL;
  for (const std::int64_t c : {x, y, z}) {
    h ^= static_cast<std::uint64_t>(c) + 0x9E3779B97F4A7C15ULL + (h << 6) + (h >> 2);
    h ^= h >> 33;
    h *= 0xFF51AFD7ED558CCDULL;
    h ^= h >> 33;
  }
  return static_cast<std::uint32_t>(h >> 32);
}

// Dot product with one of the twelve edge directions of a cube.
double gradient(std::uint32_t h, double x, double y, double z) {
  const std::uint32_t which = h & 15U;
  const double u = which < 8 ? x : y;
  const double v = which < 4 ? y : which == 12 || which == 14 ? x : z;
  return ((which & 1U) ? -u : u) + ((which & 2U) ? -v : v);
}

double fade(double t) {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

double between(double a, double b, double w) {
  return a + (b - a) * w;
}

}  // namespace

double perlin(double x, double y, double z, std::uint32_t seed) {
  const double fx = std::floor(x);
  const double fy = std::floor(y);
  const double fz = std::floor(z);
  const auto ix = static_cast<std::int64_t>(fx);
  const auto iy = static_cast<std::int64_t>(fy);
  const auto iz = static_cast<std::int64_t>(fz);
  const double dx = x - fx;
  const double dy = y - fy;
  const double dz = z - fz;
  const auto corner = [&](int i, int j, int k) {
    return gradient(hash(ix + i, iy + j, iz + k, seed), dx - i, dy - j, dz - k);
  };
  const double u = fade(dx);
  const double v = fade(dy);
  const auto layer = [&](int k) {
    return between(between(corner(0, 0, k), corner(1, 0, k), u), between(corner(0, 1, k), corner(1, 1, k), u), v);
  };
  return between(layer(0), layer(1), fade(dz));
}

Octaves perlin_octaves(double x, double y, double z, int octaves, double persistence, double finest,
                       std::uint32_t seed) {
  constexpr double kDeviation = 0.27;  // of one octave
  double sum = 0.0;
  double variance = 0.0;
  double kept = 0.0;
  double amplitude = 1.0;
  double frequency = 1.0;
  for (int i = 0; i < octaves; ++i) {
    variance += amplitude * amplitude;
    const double resolved = std::clamp(2.0 - 2.0 * frequency * finest, 0.0, 1.0);
    if (resolved > 0.0) {
      sum += resolved * amplitude * perlin(x * frequency, y * frequency, z, seed + static_cast<std::uint32_t>(i));
      kept += resolved * resolved * amplitude * amplitude;
    }
    amplitude *= persistence;
    frequency *= 2.0;
  }
  return {sum / (kDeviation * std::sqrt(variance)), std::sqrt(1.0 - kept / variance)};
}

}  // namespace render
