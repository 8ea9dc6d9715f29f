#include "render/medium/medium.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

double extinction_at(const Medium& medium, const glm::dvec3& point_in_world) {
  if (!medium.falloff || medium.extinction_per_m == 0.0) return medium.extinction_per_m;
  return medium.extinction_per_m *
         std::exp(-(point_in_world.z - medium.falloff->base_m) / medium.falloff->scale_height_m);
}

double optical_depth(const Medium& medium, const glm::dvec3& from_in_world, const glm::dvec3& direction_in_world,
                     double length_m) {
  require(length_m >= 0.0, "optical_depth: length must not be negative", length_m);
  if (medium.extinction_per_m == 0.0 || length_m == 0.0) return 0.0;
  if (!medium.falloff) return medium.extinction_per_m * length_m;
  const double scale = medium.falloff->scale_height_m;
  require(scale > 0.0, "optical_depth: scale height must be positive", scale);
  const double rise = direction_in_world.z / scale;  // scale heights a metre
  if (std::isinf(length_m)) {
    return rise > 0.0 ? extinction_at(medium, from_in_world) / rise : std::numeric_limits<double>::infinity();
  }
  const double x = std::abs(rise * length_m);
  const glm::dvec3 low = rise < 0.0 ? from_in_world + direction_in_world * length_m : from_in_world;
  return extinction_at(medium, low) * length_m * (x == 0.0 ? 1.0 : -std::expm1(-x) / x);
}

double sun_optical_depth(const Medium& medium, const glm::dvec3& point_in_world,
                         const glm::dvec3& sun_direction_in_world) {
  if (!medium.extent) return 0.0;
  double way = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double sun = sun_direction_in_world[i];
    if (sun == 0.0) continue;
    const double face = sun > 0.0 ? medium.extent->max_in_world[i] : medium.extent->min_in_world[i];
    way = std::min(way, (face - point_in_world[i]) / sun);
  }
  return optical_depth(medium, point_in_world, sun_direction_in_world, std::max(way, 0.0));
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
