#include "render/medium/medium.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace render {
namespace {

constexpr double kInverseSphere = 1.0 / (4.0 * std::numbers::pi);

void require(bool holds, const char* what, double found) {
  if (!holds) throw std::invalid_argument(std::string(what) + ", found " + std::to_string(found));
}

// (1 - g^2) / (1 + g^2 - 2 g cos)^1.5 with the squared distance written so that it does not cancel near g cos = 1.
double henyey_greenstein_shape(double g, double cos_theta) {
  const double gap = 1.0 - std::abs(g);
  const double away = g >= 0.0 ? 1.0 - cos_theta : 1.0 + cos_theta;
  const double squared = gap * gap + 2.0 * std::abs(g) * away;
  return (1.0 - g * g) / (squared * std::sqrt(squared));
}

}  // namespace

double phase(PhaseFunction function, double g, double cos_theta) {
  require(std::abs(g) < 1.0, "phase: g must lie inside (-1, 1)", g);
  const double mu = std::fmin(std::fmax(cos_theta, -1.0), 1.0);
  switch (function) {
    case PhaseFunction::HenyeyGreenstein:
      return kInverseSphere * henyey_greenstein_shape(g, mu);
    case PhaseFunction::CornetteShanks:  // Cornette & Shanks 1992, eq. 8
      return kInverseSphere * 1.5 * (1.0 + mu * mu) / (2.0 + g * g) * henyey_greenstein_shape(g, mu);
    case PhaseFunction::Rayleigh:
      return kInverseSphere * 0.75 * (1.0 + mu * mu);
  }
  throw std::invalid_argument("phase: unknown phase function");
}

double extinction_from_visibility(double visibility_m) {
  require(visibility_m > 0.0, "extinction_from_visibility: visibility must be positive", visibility_m);
  return 2.996 / visibility_m;
}

double scattered_fraction(double extinction_per_m, double distance_m) {
  require(extinction_per_m >= 0.0, "scattered_fraction: extinction must not be negative", extinction_per_m);
  require(distance_m >= 0.0, "scattered_fraction: distance must not be negative", distance_m);
  if (extinction_per_m == 0.0) return 0.0;  // also where the distance is infinite
  return -std::expm1(-extinction_per_m * distance_m);
}

double transmittance(double extinction_per_m, double distance_m) {
  require(extinction_per_m >= 0.0, "transmittance: extinction must not be negative", extinction_per_m);
  require(distance_m >= 0.0, "transmittance: distance must not be negative", distance_m);
  if (extinction_per_m == 0.0) return 1.0;
  return std::exp(-extinction_per_m * distance_m);
}

glm::dvec3 phase_moments(PhaseFunction function, double g) {
  require(std::abs(g) < 1.0, "phase_moments: g must lie inside (-1, 1)", g);
  const double g2 = g * g;
  switch (function) {
    case PhaseFunction::HenyeyGreenstein:
      return {1.0, g, g2};
    case PhaseFunction::CornetteShanks: {
      const double norm = 1.5 / (2.0 + g2);
      return {1.0, norm * g * (8.0 + 2.0 * g2) / 5.0, norm * (32.0 / 21.0 * g2 + 12.0 / 35.0 * g2 * g2 + 2.0 / 15.0)};
    }
    case PhaseFunction::Rayleigh:
      return {1.0, 0.0, 0.1};
  }
  throw std::invalid_argument("phase_moments: unknown phase function");
}

}  // namespace render
