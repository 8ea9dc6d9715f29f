#pragma once

#include <memory>

#include "render/base/angles.h"
#include "render/sky/sky_model.h"

namespace render {

// Where a daytime model hands over to computed twilight, as geometric elevations of the sun in radians.
struct Handover {
  double day_from_rad = 0.0;        // above it the daytime model stands alone
  double twilight_below_rad = 0.0;  // below it computed twilight stands alone
};

inline constexpr Handover kClearHandover{8.0 * kRadPerDeg,
                                         0.0};  // turbid models lose their colours in the last degrees
inline constexpr Handover kGivenHandover{0.0, -4.0 * kRadPerDeg};  // what was asked for holds as long as the sun is up

// Carries a model that knows the day alone through sunset: from `day` to the scattering of a clear atmosphere with the
// sun below the horizon, both scaled so that level ground receives `level_lux`. `clearness` in [0, 1] says how much of
// the twilight's colours shows: 0 under an overcast, which only dims.
std::unique_ptr<SkyModel> make_dusk_sky(std::unique_ptr<SkyModel> day, const SunPosition& sun, double turbidity,
                                        double level_lux, const Handover& handover, double clearness);

}  // namespace render
