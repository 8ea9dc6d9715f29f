#pragma once

#include <glm/vec3.hpp>

namespace render {

// The sun's disc is darker and redder towards its limb: I(mu) = mu^alpha, mu = sqrt(1 - r^2) (Hestroffer & Magnan 1998,
// Astronomy & Astrophysics 333, 338-342). r in [0, 1] is the distance from the disc's middle in radii.

// alpha = -0.023 + 0.292 um / wavelength, published for 416 to 1,100 nm and continued to 380, where eyes see little.
double limb_darkening_exponent(double wavelength_nm);

// Radiance at r over the disc's mean: 1 + alpha / 2 in the middle, 0 at the limb. Its mean over the disc is 1.
double limb_darkening(double r, double wavelength_nm);

// The same for the white light of the sun outside the air, linear Rec. 709 over the disc's mean colour: multiply a disc
// of even luminance by it.
glm::dvec3 limb_darkening_rgb(double r);

// Share of the disc's light that passes a straight edge `height` radii below its middle: 0 at -1, 0.5 at 0, 1 at 1,
// held outside. Smaller than the share of area as long as less than half of the disc is up.
double visible_light_share(double height, double wavelength_nm);

// Radius of the even disc whose penumbrae have the same width (second moment) as the darkened one's, over the disc's.
double even_disc_radius();

}  // namespace render
