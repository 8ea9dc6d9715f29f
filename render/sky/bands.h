#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace render {

// The wavelengths at which scattering is computed: 400 to 700 nm every 30 nm. Between them quantities relative to the
// sun's spectrum are interpolated linearly: they are smooth where the sun's own lines are not.
inline constexpr std::size_t kBandCount = 11;
using Bands = std::array<double, kBandCount>;
constexpr double band_um(std::size_t band) {
  return 0.400 + 0.030 * static_cast<double>(band);
}

// XYZ in cd/m2 of a radiance given as multiples (1/sr) of the sun's spectral irradiance outside the atmosphere at 1 au.
glm::dvec3 xyz_from_solar_multiples(const Bands& multiples_per_sr);

}  // namespace render
