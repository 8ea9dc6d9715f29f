#pragma once

#include <glm/vec3.hpp>

#include "render/sun/place_time.h"

namespace render {

// The three ways to the sun that sun_position() chooses from. Each returns the vector from `place` to the sun's centre
// in the world's axes (east, north, up), without air, in astronomical units.

// The papers' day-of-year formula: declination and equation of time from the whole day of the UTC year (Preetham,
// Shirley, Smits 1999, appendix A.6, after the IES handbook). Within 1.4 degrees of the truth, 1950-2100.
glm::dvec3 daily_sun_au(const Place& place, UtcTime time);

// PSA+ (Blanco, Milidonis, Bonanos 2020, "Updating the PSA sun position algorithm", Solar Energy 212), with the sun's
// parallax. Within 0.012 degrees of the truth, 1950-2100.
glm::dvec3 psa_sun_au(const Place& place, UtcTime time);

// The IAU's models through ERFA with UT1 = UTC and no polar motion: light time, aberration, precession and nutation
// (2000B: within 0.003 arc seconds of 2006/2000A from 1950 to 2100), parallax on WGS 84. The reference.
glm::dvec3 precise_sun_au(const Place& place, UtcTime time);

}  // namespace render
