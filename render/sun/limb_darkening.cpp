#include "render/sun/limb_darkening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/base/check.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

constexpr double kMeanWavelengthNm = 555.0;  // of the luminous sun
constexpr int kRings = 64;

// Integral of cos^n from 0 to `angle` by Simpson's rule: the light of the chords between the disc's middle and
// sin(angle), for a chord at y holds (1 - y^2)^((alpha + 1) / 2) of it.
double integral_of_cosine_power(double exponent, double angle) {
  constexpr int kSteps = 32;
  const double step = angle / kSteps;
  double sum = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double weight = i == 0 || i == kSteps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * std::pow(std::max(std::cos(i * step), 0.0), exponent);
  }
  return sum * step / 3.0;
}

// The disc's colour at r, not yet divided by its mean.
glm::dvec3 disc_color(double r) {
  Spectrum spectrum = extraterrestrial_irradiance();
  for (int i = 0; i < kSpectrumSamples; ++i) {
    spectrum[static_cast<std::size_t>(i)] *= limb_darkening(r, wavelength_nm(i));
  }
  return rgb_from_xyz(xyz_from_spectrum(spectrum));
}

// Values at even steps of mu, along which they change slowly: r = sqrt(1 - mu^2).
std::array<glm::dvec3, kRings + 1> tabulate() {
  std::array<glm::dvec3, kRings + 1> table;
  const glm::dvec3 mean = rgb_from_xyz(xyz_from_spectrum(extraterrestrial_irradiance()));
  for (int i = 0; i <= kRings; ++i) {
    const double mu = static_cast<double>(i) / kRings;
    table[static_cast<std::size_t>(i)] = glm::max(disc_color(std::sqrt(1.0 - mu * mu)) / mean, glm::dvec3(0.0));
  }
  return table;
}

}  // namespace

double limb_darkening_exponent(double wavelength_nm) {
  CHECK(wavelength_nm > 0.0);
  return -0.023 + 0.292 * 1e3 / wavelength_nm;
}

double limb_darkening(double r, double wavelength_nm) {
  CHECK(r >= 0.0);
  const double alpha = limb_darkening_exponent(wavelength_nm);
  const double mu2 = std::max(1.0 - r * r, 0.0);
  return (1.0 + 0.5 * alpha) * std::pow(mu2, 0.5 * alpha);
}

glm::dvec3 limb_darkening_rgb(double r) {
  static const std::array<glm::dvec3, kRings + 1> table = tabulate();
  const double position = std::sqrt(std::clamp(1.0 - r * r, 0.0, 1.0)) * kRings;
  const auto low = static_cast<std::size_t>(std::min(position, kRings - 1.0));
  const double weight = position - static_cast<double>(low);
  return table[low] + (table[low + 1] - table[low]) * weight;
}

double visible_light_share(double height, double wavelength_nm) {
  if (height <= -1.0) return 0.0;
  if (height >= 1.0) return 1.0;
  const double exponent = limb_darkening_exponent(wavelength_nm) + 2.0;
  return 0.5 + 0.5 * integral_of_cosine_power(exponent, std::asin(height)) /
                   integral_of_cosine_power(exponent, 0.5 * std::numbers::pi);
}

double even_disc_radius() {
  // The mean of r^2 is 1 / (2 + alpha / 2); an even disc's is half its radius squared.
  return std::sqrt(2.0 / (2.0 + 0.5 * limb_darkening_exponent(kMeanWavelengthNm)));
}

}  // namespace render
