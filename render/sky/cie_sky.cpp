// The CIE's standard general skies (CIE S 011 / ISO 15469) as skies.

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <stdexcept>

#include "render/sky/cie.h"
#include "render/sky/dusk_sky.h"
#include "render/sky/form_sky.h"
#include "render/sky/reference_sky.h"
#include "render/sky/sky_condition.h"
#include "render/sky/sky_model_list.h"
#include "render/sky/twilight.h"

namespace render {
namespace {

const std::string kPrefix = "cie:";

int cie_type(const std::string& text) {
  try {
    std::size_t used = 0;
    const int type = std::stoi(text, &used);
    if (used == text.size() && type >= 1 && type <= 15) return type;
  } catch (const std::logic_error&) {
    // not a number: the same message
  }
  throw std::runtime_error("unknown sky model `" + kPrefix + text + "`\nthe CIE skies are cie:1 to cie:15");
}

// The standard leaves level and colour open: between Krochmann's overcast (300 + 21000 sin) and the clear-sky model.
std::unique_ptr<SkyModel> cie(const SkyOptions& options, const SunPosition& sun) {
  const int type = cie_type(options.model.substr(kPrefix.size()));
  const Day day = day_of(sun);
  const double clearness = cie_clearness(type);
  const double overcast_lux = 300.0 + 21000.0 * std::sin(day.sun.elevation_rad);
  const double clear_lux = std::max(clear_condition(options, day).diffuse_lux, 1.0);
  const double lux = std::exp(glm::mix(std::log(overcast_lux), std::log(clear_lux), clearness));
  SkyForm form{cie_shape(type), Indicatrix::Cie, options.turbidity, nullptr, 1.0 - clearness};
  if (clearness > 0.0) form.colors = make_reference_colors(options.turbidity, day.sun);
  return make_dusk_sky(make_form_sky(form, day.sun, lux), sun, options.turbidity,
                       lux * twilight_dimming(sun.elevation_rad), kGivenHandover, clearness);
}

}  // namespace

SkyModelInfo cie_model() {
  SkyModelInfo info{.written = "cie:1 to cie:15",
                    .prefix = kPrefix,
                    .summary =
                        "CIE S 011 / ISO 15469. The standard gives no level and no colour: both go from an "
                        "overcast (Krochmann: 300 + 21,000 sin h lux, D65) to the clear sky with the type.",
                    .turbidity = TurbidityLimits{1.0, 20.0},
                    .make = cie};
  for (int type = 1; type <= 15; ++type) info.words.push_back(kPrefix + std::to_string(type));
  return info;
}

}  // namespace render
