#pragma once

#include "render/sky/perez.h"

namespace render {

// One of the fifteen standard general skies (CIE S 011 / ISO 15469:2004, table 1): 1 and 5 overcast and uniform, 12
// clear with low turbidity, 15 white-blue turbid. Throws std::invalid_argument outside 1 to 15.
PerezShape cie_shape(int type);

// Gradation times indicatrix of a standard general sky (ISO 15469, eq. 2-6). Unlike Perez's form the indicatrix is
// 1 + c (exp(d gamma) - exp(d pi / 2)) + e cos^2 gamma. Divide by the zenith's value for L / Lz.
double cie_luminance(const PerezShape& shape, double cos_view_zenith, double gamma_rad, double cos_gamma);

// How much of the light of the type comes from a clear sky: 0 overcast (types 1 to 4) to 1 clear (11 to 15), between
// them for the partly cloudy ones. It mixes level and colour, which the standard leaves open.
double cie_clearness(int type);

}  // namespace render
