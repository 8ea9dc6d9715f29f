#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "render/base/box.h"

namespace render {

// Phase functions, each integrating to 1 over the sphere. cos_theta is the cosine between the light's direction of
// travel and the direction from the scattering point to the eye: g > 0 is bright when looking towards the light.
enum class PhaseFunction { HenyeyGreenstein, CornetteShanks, Rayleigh };
// cos_theta is clamped to [-1, 1]; throws std::invalid_argument where |g| >= 1. Unit 1/sr.
// Henyey & Greenstein 1941; Cornette & Shanks 1992, eq. 8; Rayleigh ignores g.
double phase(PhaseFunction function, double g, double cos_theta);

// Legendre moments of bands 0, 1, 2: 2 pi integral of p(mu) P_l(mu) over [-1, 1]. Band 0 is 1. A spherical harmonic
// of band l that scatters comes out multiplied by moment l (Funk-Hecke).
glm::dvec3 phase_moments(PhaseFunction function, double g);

// Air that thins out upwards: sigma_t(z) = extinction_per_m * exp(-(z - base_m) / scale_height_m).
struct HeightFalloff {
  double base_m = 0.0;            // z in the world at which sigma_t is the medium's extinction_per_m
  double scale_height_m = 100.0;  // > 0
};

// A participating medium, homogeneous or thinning out with height (docs/shafts.md).
struct Medium {
  double extinction_per_m = 0.0;  // sigma_t, >= 0; with a falloff, at its base
  double albedo = 0.95;           // sigma_s / sigma_t, [0, 1]
  PhaseFunction phase_function = PhaseFunction::HenyeyGreenstein;
  double g = 0.7;                                       // (-1, 1)
  std::optional<Box> extent = std::nullopt;             // absent: unbounded
  std::optional<HeightFalloff> falloff = std::nullopt;  // absent: homogeneous
  // An artist's gains, >= 0; 1 is physical. Transmittance stays as it is.
  double shaft_gain = 1.0;  // of the sun's light that is scattered
  double fog_gain = 1.0;    // of the sky's
};

// sigma_t = 2.996 / visibility (5 % contrast). Throws std::invalid_argument where the visibility is not positive.
double extinction_from_visibility(double visibility_m);

// Closed form for an unoccluded homogeneous segment: integral of sigma_t T(t) dt from 0 to d = 1 - exp(-sigma_t d),
// accurate for sigma_t d -> 0. Distance may be infinite.
double scattered_fraction(double extinction_per_m, double distance_m);

// exp(-sigma_t d); 1 where sigma_t is 0, even at infinite distance.
double transmittance(double extinction_per_m, double distance_m);

// sigma_t at a point inside the medium, 1/m; does not look at `extent`.
double extinction_at(const Medium& medium, const glm::dvec3& point_in_world);

// Integral of sigma_t over `length_m` (may be infinite) from `from_in_world` along a unit direction; does not look at
// `extent`. With a falloff, sigma_t of the lower end times length times (1 - exp(-x)) / x with x the rise in scale
// heights: accurate to rounding for level rays too. Infinite where an endless ray does not rise.
double optical_depth(const Medium& medium, const glm::dvec3& from_in_world, const glm::dvec3& direction_in_world,
                     double length_m);

// Optical depth that sunlight has crossed inside the medium when it reaches a point of it: from where it enters the
// extent; 0 for a medium without bounds, which takes the sun's light as given everywhere (docs/shafts.md).
double sun_optical_depth(const Medium& medium, const glm::dvec3& point_in_world,
                         const glm::dvec3& sun_direction_in_world);

}  // namespace render
