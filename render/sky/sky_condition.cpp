#include "render/sky/sky_condition.h"

#include <algorithm>
#include <numbers>

#include "render/sky/clear_sky_irradiance.h"

namespace render {
namespace {

constexpr double kLowestClearSkyRad = 3.0 * std::numbers::pi / 180.0;

Condition condition_from(const SkyIrradiance& irradiance, const Day& day, PerezBins bins) {
  const double clearness = sky_clearness(irradiance.dni_wm2, irradiance.dhi_wm2, day.zenith_rad);
  const double brightness = sky_brightness(irradiance.dhi_wm2, day.zenith_rad, day.outside_wm2);
  const double efficacy = diffuse_efficacy(clearness, brightness, day.zenith_rad, bins);
  return {clearness, brightness, std::max(irradiance.dhi_wm2, 0.0) * efficacy};
}

Condition given_condition(const SkyCondition& given, const Day& day, PerezBins bins) {
  const double dhi_wm2 = dhi_from_brightness(given.brightness, day.zenith_rad, day.outside_wm2);
  const double efficacy = diffuse_efficacy(given.clearness, given.brightness, day.zenith_rad, bins);
  return {given.clearness, given.brightness, dhi_wm2 * efficacy};
}

}  // namespace

Day day_of(const SunPosition& sun) {
  Day day{sun, 0.0, kSolarConstantWm2 / (sun.distance_au * sun.distance_au)};
  day.sun.elevation_rad = std::max(sun.elevation_rad, 0.0);
  day.zenith_rad = std::numbers::pi / 2.0 - day.sun.elevation_rad;
  return day;
}

Condition clear_condition(const SkyOptions& options, Day day) {
  const double elevation = std::max(day.sun.elevation_rad, kLowestClearSkyRad);
  day.zenith_rad = std::numbers::pi / 2.0 - elevation;
  const ClearSkyIrradiance clear =
      clear_sky_irradiance(options.turbidity, elevation, options.height_m, day.outside_wm2);
  return condition_from({clear.dni_wm2, clear.dhi_wm2}, day, options.bins);
}

Condition condition_of(const SkyOptions& options, const Day& day) {
  if (options.condition) return given_condition(*options.condition, day, options.bins);
  if (options.irradiance) return condition_from(*options.irradiance, day, options.bins);
  return clear_condition(options, day);
}

std::optional<double> given_sun_lux(const SkyOptions& options, const SunPosition& sun) {
  if (!options.condition && !options.irradiance) return std::nullopt;
  const Day day = day_of(sun);
  const Condition condition = condition_of(options, day);
  const double dhi_wm2 = dhi_from_brightness(condition.brightness, day.zenith_rad, day.outside_wm2);
  const double dni_wm2 = options.condition ? dni_from_clearness(condition.clearness, dhi_wm2, day.zenith_rad)
                                           : std::max(options.irradiance->dni_wm2, 0.0);
  const double efficacy = direct_efficacy(condition.clearness, condition.brightness, day.zenith_rad, options.bins);
  return dni_wm2 * efficacy;
}

}  // namespace render
