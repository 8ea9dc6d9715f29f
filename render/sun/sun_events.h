#pragma once

#include <optional>

#include "render/sun/sun.h"

namespace render {

// Elevation of the sun's centre at rise and set: 34' of refraction and 16' of radius below the horizon, the
// almanacs' convention.
inline constexpr double kSunriseElevationRad = -0.833 * 0.017453292519943295;

// What the sun does in one solar day: the 24 hours centred on the transit that is nearest to the time asked for.
struct SunEvents {
  UtcTime transit;                     // upper culmination: the sun is highest
  double transit_elevation_rad = 0.0;  // geometric
  std::optional<UtcTime> rise;         // nothing on a day without one (polar day and night)
  std::optional<UtcTime> set;
  bool always_up = false;  // above the threshold through the whole solar day
};

// Times at which the centre's geometric elevation passes `threshold_rad` upwards and downwards; give -6, -12 or -18
// degrees for the twilights. Within a second of the tier's own sun. At a pole, where the sun circles, `transit` is the
// highest point found.
SunEvents sun_events(const Place& place, UtcTime time, double threshold_rad = kSunriseElevationRad,
                     SunTier tier = SunTier::Precise);

// Apparent minus mean solar time, in seconds: positive when the sundial is fast (about +16 min in early November).
double equation_of_time_s(UtcTime time, SunTier tier = SunTier::Precise);

}  // namespace render
