#include "render/sun/sun_events.h"

#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>

namespace render {
namespace {

using std::chrono::microseconds;
using Seconds = std::chrono::duration<double>;

constexpr double kDayS = 86400.0;
constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr int kScanSteps = 144;  // ten minutes: finer than any two crossings of one threshold that matter
constexpr double kTimePrecisionS = 0.1;

UtcTime after(UtcTime time, double seconds) {
  return time + std::chrono::round<microseconds>(Seconds(seconds));
}

// Hour angle of the sun at the place's meridian, in (-pi, pi], seen from the equator so that it is never undefined.
double hour_angle(double longitude_rad, UtcTime time, SunTier tier) {
  const Place equator{0.0, longitude_rad, 0.0};
  const glm::dvec3 sun = sun_position(equator, time, tier).direction_in_world();
  return std::atan2(-sun.x, sun.z);
}

// Newton's iteration on the hour angle, whose rate differs from the mean day's by less than 1 in 2,000.
UtcTime nearest_transit(const Place& place, UtcTime time, SunTier tier) {
  for (int i = 0; i < 4; ++i) time = after(time, -hour_angle(place.longitude_rad, time, tier) / kTwoPi * kDayS);
  return time;
}

// The crossing of zero between a and b, where f changes sign; seconds.
double bisect(const std::function<double(double)>& f, double a, double b) {
  const bool rises = f(a) < 0.0;
  while (b - a > kTimePrecisionS) {
    const double middle = 0.5 * (a + b);
    ((f(middle) < 0.0) == rises ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

}  // namespace

SunEvents sun_events(const Place& place, UtcTime time, double threshold_rad, SunTier tier) {
  SunEvents events;
  events.transit = nearest_transit(place, time, tier);
  events.transit_elevation_rad = sun_position(place, events.transit, tier).elevation_rad;
  const std::function<double(double)> height = [&](double seconds) {
    return sun_position(place, after(events.transit, seconds), tier).elevation_rad - threshold_rad;
  };
  events.always_up = true;
  const double step = kDayS / kScanSteps;
  double before = height(-0.5 * kDayS);
  for (int i = 0; i < kScanSteps; ++i) {
    const double start = -0.5 * kDayS + step * i;
    const double here = height(start + step);
    events.always_up = events.always_up && before >= 0.0 && here >= 0.0;
    if (before < 0.0 && here >= 0.0) events.rise = after(events.transit, bisect(height, start, start + step));
    if (before >= 0.0 && here < 0.0) events.set = after(events.transit, bisect(height, start, start + step));
    before = here;
  }
  return events;
}

double equation_of_time_s(UtcTime time, SunTier tier) {
  const Seconds since_midnight = time - std::chrono::floor<std::chrono::days>(time);
  const double mean_hour_angle = (since_midnight.count() / kDayS - 0.5) * kTwoPi;
  return std::remainder(hour_angle(0.0, time, tier) - mean_hour_angle, kTwoPi) / kTwoPi * kDayS;
}

}  // namespace render
