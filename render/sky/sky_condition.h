#pragma once

#include "render/sky/sky_model.h"

namespace render {

// The sun where the daytime models end: on the horizon or above.
struct Day {
  SunPosition sun;
  double zenith_rad = 0.0;
  double outside_wm2 = 0.0;  // irradiance facing the sun outside the atmosphere
};
Day day_of(const SunPosition& sun);

// What the Perez model is told, and the illuminance of level ground that goes with it.
struct Condition {
  double clearness = 1.0;
  double brightness = 0.2;
  double diffuse_lux = 0.0;
};

// The condition that `options` give for that day: outright, by irradiances, or by turbidity.
Condition condition_of(const SkyOptions& options, const Day& day);

// By turbidity alone, through the clear-sky irradiance model. Irradiances mean little with the sun lower than 3
// degrees: the condition there is kept.
Condition clear_condition(const SkyOptions& options, Day day);

}  // namespace render
