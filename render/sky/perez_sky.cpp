// Perez, Seals & Michalsky 1993 as a sky.

#include <algorithm>

#include "render/sky/dusk_sky.h"
#include "render/sky/form_sky.h"
#include "render/sky/reference_sky.h"
#include "render/sky/sky_condition.h"
#include "render/sky/sky_model_list.h"
#include "render/sky/twilight.h"

namespace render {
namespace {

std::unique_ptr<SkyModel> perez(const SkyOptions& options, const SunPosition& sun) {
  const Day day = day_of(sun);
  const bool given = options.condition || options.irradiance;
  const Condition condition = condition_of(options, day);
  SkyForm form;
  form.shape =
      without_dark_zenith(perez_shape(condition.clearness, condition.brightness, day.zenith_rad, options.bins));
  form.colors = make_reference_colors(options.turbidity, day.sun);
  form.whiteness = std::clamp((1.5 - condition.clearness) / 0.5, 0.0, 1.0);  // clearness 1 is a grey sky
  const double level = given ? condition.diffuse_lux * twilight_dimming(sun.elevation_rad)
                             : diffuse_level_lux(condition.diffuse_lux, sun, options.turbidity);
  return make_dusk_sky(make_form_sky(form, day.sun, condition.diffuse_lux), sun, options.turbidity, level,
                       given ? kGivenHandover : kClearHandover, 1.0 - form.whiteness);
}

}  // namespace

SkyModelInfo perez_model() {
  return {.written = "perez",
          .words = {"perez"},
          .summary =
              "Perez, Seals, Michalsky 1993: shape from clearness ε and brightness Δ, those from a clear-sky model "
              "(Ineichen & Perez 2002) by turbidity and height, or given outright. Colours from the reference. Level: "
              "the integral over the sky equals the diffuse illuminance (Perez 1990 efficacies).",
          .turbidity = TurbidityLimits{1.0, 20.0},
          .make = perez};
}

}  // namespace render
