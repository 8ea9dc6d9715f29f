// Preetham, Shirley & Smits 1999 as skies: as published, and in the clear-sky model's level.

#include <algorithm>

#include "render/sky/dusk_sky.h"
#include "render/sky/form_sky.h"
#include "render/sky/hemisphere.h"
#include "render/sky/preetham.h"
#include "render/sky/sky_condition.h"
#include "render/sky/sky_model_list.h"
#include "render/sky/twilight.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

std::unique_ptr<SkyModel> preetham(const SkyOptions& options, const SunPosition& sun, bool rescaled) {
  const Day day = day_of(sun);
  SkyOptions clear = options;
  if (rescaled) clear.turbidity = std::max(options.turbidity, 2.0);
  const double turbidity = clear.turbidity;
  const SkyForm form{preetham_shapes(turbidity).luminance, Indicatrix::Perez, turbidity, nullptr, 0.0};
  const double zenith_cdm2 = std::max(preetham_zenith(turbidity, day.zenith_rad).luminance_kcdm2, 0.0) * 1e3;
  auto published = make_form_sky_at_zenith(form, day.sun, zenith_cdm2);
  if (rescaled) {
    const double level = diffuse_level_lux(clear_condition(clear, day).diffuse_lux, sun, turbidity);
    return make_dusk_sky(std::move(published), sun, turbidity, level, kClearHandover, 1.0);
  }
  const double level = luminance(horizontal_illuminance(*published)) * twilight_dimming(sun.elevation_rad);
  return make_dusk_sky(std::move(published), sun, turbidity, level, kGivenHandover, 1.0);
}

}  // namespace

SkyModelInfo preetham_model() {
  return {.written = "preetham",
          .words = {"preetham"},
          .summary =
              "Preetham, Shirley, Smits 1999, as published (four-decimal tables). Its luminance is 2.3 times too "
              "bright.",
          .turbidity = TurbidityLimits{1.7, 10.0},
          .make = [](const SkyOptions& options, const SunPosition& sun) { return preetham(options, sun, false); }};
}

SkyModelInfo preetham_rescaled_model() {
  return {.written = "preetham:rescaled",
          .words = {"preetham:rescaled"},
          .summary = "The same, scaled to the clear-sky model's diffuse illuminance.",
          .turbidity = TurbidityLimits{2.0, 10.0},
          .make = [](const SkyOptions& options, const SunPosition& sun) { return preetham(options, sun, true); }};
}

}  // namespace render
