#include "render/sun/spectrum.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace render {
namespace {

constexpr double kLuminousEfficacy = 683.0;          // lm/W
constexpr double kLuminousSolarConstant = 133100.0;  // lux at 1 au, ASTM E490

constexpr Spectrum kX = {0.0014, 0.0042, 0.0143, 0.0435, 0.1344, 0.2839, 0.3483, 0.3362, 0.2908, 0.1954, 0.0956,
                         0.0320, 0.0049, 0.0093, 0.0633, 0.1655, 0.2904, 0.4334, 0.5945, 0.7621, 0.9163, 1.0263,
                         1.0622, 1.0026, 0.8544, 0.6424, 0.4479, 0.2835, 0.1649, 0.0874, 0.0468, 0.0227, 0.0114,
                         0.0058, 0.0029, 0.0014, 0.0007, 0.0003, 0.0002, 0.0001, 0.0000};
constexpr Spectrum kY = {0.0000, 0.0001, 0.0004, 0.0012, 0.0040, 0.0116, 0.0230, 0.0380, 0.0600, 0.0910, 0.1390,
                         0.2080, 0.3230, 0.5030, 0.7100, 0.8620, 0.9540, 0.9950, 0.9950, 0.9520, 0.8700, 0.7570,
                         0.6310, 0.5030, 0.3810, 0.2650, 0.1750, 0.1070, 0.0610, 0.0320, 0.0170, 0.0082, 0.0041,
                         0.0021, 0.0010, 0.0005, 0.0002, 0.0001, 0.0001, 0.0000, 0.0000};
constexpr Spectrum kZ = {0.0065, 0.0201, 0.0679, 0.2074, 0.6456, 1.3856, 1.7471, 1.7721, 1.6692, 1.2876, 0.8130,
                         0.4652, 0.2720, 0.1582, 0.0782, 0.0422, 0.0203, 0.0087, 0.0039, 0.0021, 0.0017, 0.0011,
                         0.0008, 0.0003, 0.0002, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000,
                         0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000};

// ASTM G173-03, extraterrestrial column, W/m2/nm: means over [370, 380), [380, 390) ... [780, 790) nm.
constexpr std::array<double, kSpectrumSamples + 1> kSolarBins = {
    1.14259, 1.01249, 1.14716, 1.72765, 1.73054, 1.6887,  1.61253, 1.91198, 2.03474, 2.02042, 2.02212,
    1.93377, 1.95809, 1.91686, 1.8298,  1.8685,  1.8931,  1.85149, 1.8504,  1.8341,  1.8345,  1.8147,
    1.78158, 1.7533,  1.6965,  1.68194, 1.64654, 1.6048,  1.52143, 1.55622, 1.5113,  1.474,   1.4482,
    1.41018, 1.36775, 1.34188, 1.31429, 1.28303, 1.26758, 1.2367,  1.2082,  1.18737};

// Columns: what one unit of R, G, B adds to X, Y, Z.
const glm::dmat3 kXyzFromRgb = {{0.4123907993, 0.2126390059, 0.0193308187},
                                {0.3575843394, 0.7151686788, 0.1191947798},
                                {0.1804807884, 0.0721923154, 0.9505321522}};
const glm::dmat3 kRgbFromXyz = glm::inverse(kXyzFromRgb);

Spectrum scaled_to_solar_constant() {
  Spectrum spectrum;
  for (std::size_t i = 0; i < spectrum.size(); ++i) spectrum[i] = 0.5 * (kSolarBins[i] + kSolarBins[i + 1]);
  const double scale = kLuminousSolarConstant / xyz_from_spectrum(spectrum).y;
  for (double& value : spectrum) value *= scale;
  return spectrum;
}

}  // namespace

glm::dvec3 color_matching_xyz(int sample) {
  const auto i = static_cast<std::size_t>(sample);
  return {kX.at(i), kY.at(i), kZ.at(i)};
}

glm::dvec3 xyz_from_spectrum(const Spectrum& spectrum_per_nm) {
  glm::dvec3 sum(0.0);
  for (int i = 0; i < kSpectrumSamples; ++i)
    sum += spectrum_per_nm[static_cast<std::size_t>(i)] * color_matching_xyz(i);
  constexpr double kStepNm = 10.0;
  return kLuminousEfficacy * kStepNm * sum;
}

glm::dvec3 rgb_from_xyz(const glm::dvec3& xyz) {
  return kRgbFromXyz * xyz;
}

glm::dvec3 xyz_from_rgb(const glm::dvec3& rgb) {
  return kXyzFromRgb * rgb;
}

glm::dvec3 xyz_from_yxy(double luminance, double x, double y) {
  const double safe_y = std::max(y, 1e-4);
  return {x / safe_y * luminance, luminance, (1.0 - x - safe_y) / safe_y * luminance};
}

double luminance(const glm::dvec3& rgb) {
  return glm::dot(rgb, glm::dvec3(0.2126390059, 0.7151686788, 0.0721923154));
}

glm::dvec3 clip_to_gamut(const glm::dvec3& rgb) {
  const double lowest = std::min({rgb.x, rgb.y, rgb.z});
  if (lowest >= 0.0) return rgb;
  const double grey = luminance(rgb);
  if (!(grey > 0.0)) return glm::dvec3(0.0);
  const double keep = grey / (grey - lowest);
  return glm::max(glm::dvec3(grey) + keep * (rgb - grey), glm::dvec3(0.0));
}

const Spectrum& extraterrestrial_irradiance() {
  static const Spectrum spectrum = scaled_to_solar_constant();
  return spectrum;
}

}  // namespace render
