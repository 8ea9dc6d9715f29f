#pragma once

#include <memory>

#include "render/sky/sky_model.h"

namespace render {

// Perez all-weather sky for a clear sky of that Linke turbidity: shape from Perez 1993, colour from Preetham 1999,
// level such that level ground receives the diffuse illuminance of the clear-sky model. Near and below the horizon the
// level follows the measured twilight.
std::unique_ptr<SkyModel> make_perez_sky(double turbidity, const SunPosition& sun);

}  // namespace render
