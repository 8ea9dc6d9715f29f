#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "render/medium/medium.h"
#include "render/sky/sky_model.h"

namespace render {

// Real spherical harmonics, bands 0 to 2, in the usual order (0,0) (1,-1) (1,0) (1,1) (2,-2) ... (2,2)
// with the world's axes (y, z, x for band 1: Ramamoorthi & Hanrahan 2001).
using Sh9 = std::array<glm::dvec3, 9>;

// Adds light of that luminance from a unit direction, spread over a small solid angle.
void add_to_sh(Sh9& radiance_sh, const glm::dvec3& direction_in_world, const glm::dvec3& luminance_rgb,
               double solid_angle_sr);

// A sky boiled down to what lighting needs.
struct SkyLight {
  Sh9 radiance_sh{};                           // luminance_rgb of sky and of the ground below the horizon
  glm::dvec3 horizontal_illuminance_rgb{0.0};  // lux on open level ground from the sky alone
  glm::dvec3 ground_luminance_rgb{0.0};        // cd/m2, of the ground below the horizon
};

// Projects `sky` over the sphere. Below the horizon stands the light that ground of that `ground_albedo` returns
// under `sky` plus `sun_horizontal_illuminance_rgb` (lux on level ground).
SkyLight sky_light(const SkyModel& sky, const glm::dvec3& sun_horizontal_illuminance_rgb, double ground_albedo = 0.2);

// Illuminance in lux of a plane with unit `normal_in_world` (Ramamoorthi & Hanrahan 2001, eq. 11-13), not below 0.
glm::dvec3 irradiance(const Sh9& radiance_sh, const glm::dvec3& normal_in_world);

// Sky light that one scattering sends to the eye: the integral of phase(theta) L(omega) over the sphere, cd/m2, not
// below 0. `view_direction_in_world` points from the eye into the picture; g > 0 is bright when looking towards bright
// sky. Of the phase function bands 0 to 2 count (Funk-Hecke theorem), which is all that radiance_sh holds.
glm::dvec3 in_scatter_luminance(const Sh9& radiance_sh, PhaseFunction function, double g,
                                const glm::dvec3& view_direction_in_world);

}  // namespace render
