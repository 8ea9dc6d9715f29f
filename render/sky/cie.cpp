#include "render/sky/cie.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace render {
namespace {

constexpr std::array<PerezShape, 15> kTypes = {{{4.0, -0.7, 0.0, -1.0, 0.0},
                                                {4.0, -0.7, 2.0, -1.5, 0.15},
                                                {1.1, -0.8, 0.0, -1.0, 0.0},
                                                {1.1, -0.8, 2.0, -1.5, 0.15},
                                                {0.0, -1.0, 0.0, -1.0, 0.0},
                                                {0.0, -1.0, 2.0, -1.5, 0.15},
                                                {0.0, -1.0, 5.0, -2.5, 0.3},
                                                {0.0, -1.0, 10.0, -3.0, 0.45},
                                                {-1.0, -0.55, 2.0, -1.5, 0.15},
                                                {-1.0, -0.55, 5.0, -2.5, 0.3},
                                                {-1.0, -0.55, 10.0, -3.0, 0.45},
                                                {-1.0, -0.32, 10.0, -3.0, 0.45},
                                                {-1.0, -0.32, 16.0, -3.0, 0.3},
                                                {-1.0, -0.15, 16.0, -3.0, 0.3},
                                                {-1.0, -0.15, 24.0, -2.8, 0.15}}};

}  // namespace

PerezShape cie_shape(int type) {
  if (type < 1 || type > 15) throw std::invalid_argument("CIE sky type must be 1 to 15, found " + std::to_string(type));
  return kTypes[static_cast<std::size_t>(type - 1)];
}

double cie_luminance(const PerezShape& shape, double cos_view_zenith, double gamma_rad, double cos_gamma) {
  const double gradation = 1.0 + shape.a * std::exp(shape.b / std::max(cos_view_zenith, 1e-3));
  const double circumsolar = std::exp(shape.d * gamma_rad) - std::exp(shape.d * std::numbers::pi / 2.0);
  return gradation * (1.0 + shape.c * circumsolar + shape.e * cos_gamma * cos_gamma);
}

double cie_clearness(int type) {
  return std::clamp((type - 4) / 7.0, 0.0, 1.0);
}

}  // namespace render
