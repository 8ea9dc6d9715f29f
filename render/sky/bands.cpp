#include "render/sky/bands.h"

#include <algorithm>
#include <cmath>

#include "render/sun/spectrum.h"

namespace render {
namespace {

// XYZ that one solar multiple in each band brings: its share of the sun's spectrum under hat functions.
std::array<glm::dvec3, kBandCount> band_colors() {
  std::array<glm::dvec3, kBandCount> colors{};
  for (std::size_t band = 0; band < kBandCount; ++band) {
    Spectrum part{};
    for (int i = 0; i < kSpectrumSamples; ++i) {
      const double position = std::clamp((wavelength_nm(i) * 1e-3 - band_um(0)) / 0.030, 0.0, kBandCount - 1.0);
      const double hat = std::max(1.0 - std::abs(position - static_cast<double>(band)), 0.0);
      part[static_cast<std::size_t>(i)] = hat * extraterrestrial_irradiance()[static_cast<std::size_t>(i)];
    }
    colors[band] = xyz_from_spectrum(part);
  }
  return colors;
}

}  // namespace

glm::dvec3 xyz_from_solar_multiples(const Bands& multiples_per_sr) {
  static const std::array<glm::dvec3, kBandCount> colors = band_colors();
  glm::dvec3 xyz(0.0);
  for (std::size_t band = 0; band < kBandCount; ++band) xyz += multiples_per_sr[band] * colors[band];
  return xyz;
}

}  // namespace render
