#pragma once

#include <memory>

#include "render/sky/perez.h"
#include "render/sky/preetham.h"
#include "render/sky/sky_model.h"

namespace render {

// Which formula multiplies gradation and indicatrix.
enum class Indicatrix { Perez, Cie };

// What a sky of the Perez family is made of.
struct SkyForm {
  PerezShape shape;
  Indicatrix indicatrix = Indicatrix::Perez;
  double color_turbidity = 3.0;            // Preetham's chromaticity for that turbidity, where there is no `colors`
  std::shared_ptr<const SkyModel> colors;  // whose chromaticity it takes, direction by direction
  double whiteness = 0.0;                  // 0: that chromaticity, 1: D65, as under an overcast
};

// A sky of that form scaled to `diffuse_lux` on level ground. The sun's elevation counts from the horizon upwards;
// what lies below the horizon has the horizon's value.
std::unique_ptr<SkyModel> make_form_sky(const SkyForm& form, const SunPosition& sun, double diffuse_lux);

// The same scaled to a zenith luminance in cd/m2 instead.
std::unique_ptr<SkyModel> make_form_sky_at_zenith(const SkyForm& form, const SunPosition& sun, double zenith_cdm2);

}  // namespace render
