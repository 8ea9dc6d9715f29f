#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace render {

// Visible spectra are sampled every 10 nm from 380 to 780 nm.
inline constexpr int kSpectrumSamples = 41;
using Spectrum = std::array<double, kSpectrumSamples>;
constexpr double wavelength_nm(int sample) {
  return 380.0 + 10.0 * sample;
}

// CIE 1931 2 degree colour matching functions (CIE 015) at sample i.
glm::dvec3 color_matching_xyz(int sample);

// Tristimulus values of a spectral quantity per nm: 683 lm/W times the sum over the colour matching functions.
// A spectral irradiance in W/m2/nm gives Y in lux, a spectral radiance in W/m2/sr/nm gives Y in cd/m2.
glm::dvec3 xyz_from_spectrum(const Spectrum& spectrum_per_nm);

// Linear Rec. 709 (D65) from CIE XYZ and back (ITU-R BT.709, IEC 61966-2-1). Colours outside the gamut give negative
// components; the luminance 0.2126 R + 0.7152 G + 0.0722 B equals Y.
glm::dvec3 rgb_from_xyz(const glm::dvec3& xyz);
glm::dvec3 xyz_from_rgb(const glm::dvec3& rgb);

// XYZ with luminance `luminance` and chromaticity x, y. y is kept above 1e-4, so that nothing divides by zero.
glm::dvec3 xyz_from_yxy(double luminance, double x, double y);

// Rec. 709 luminance of linear rgb.
double luminance(const glm::dvec3& rgb);

// Moves an out-of-gamut colour (a negative component) towards the grey of the same luminance until it is inside: hue
// and luminance stay. A colour with no positive luminance becomes black.
glm::dvec3 clip_to_gamut(const glm::dvec3& rgb);

// The sun's spectral irradiance outside the atmosphere at 1 au in W/m2/nm, scaled to the luminous solar constant
// 133.1 klx (ASTM E490). Shape: ASTM G173-03, extraterrestrial column.
const Spectrum& extraterrestrial_irradiance();

}  // namespace render
