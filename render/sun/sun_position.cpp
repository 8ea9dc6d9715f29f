#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/sun/refraction.h"
#include "render/sun/sun.h"
#include "render/sun/sun_tiers.h"

namespace render {
namespace {

constexpr double kAstronomicalUnitM = 149597870700.0;
constexpr double kSunRadiusM = 6.957e8;  // IAU 2015 resolution B3

glm::dvec3 direction(double azimuth_rad, double elevation_rad) {
  const double horizontal = std::cos(elevation_rad);
  return {std::sin(azimuth_rad) * horizontal, std::cos(azimuth_rad) * horizontal, std::sin(elevation_rad)};
}

glm::dvec3 sun_au(const Place& place, UtcTime time, SunTier tier) {
  switch (tier) {
    case SunTier::Daily:
      return daily_sun_au(place, time);
    case SunTier::Psa:
      return psa_sun_au(place, time);
    case SunTier::Precise:
      break;
  }
  return precise_sun_au(place, time);
}

}  // namespace

glm::dvec3 SunPosition::direction_in_world() const {
  return direction(azimuth_rad, elevation_rad);
}

glm::dvec3 SunPosition::apparent_direction_in_world() const {
  return direction(azimuth_rad, apparent_elevation_rad);
}

SunPosition sun_position(const Place& place, UtcTime time, SunTier tier, const Weather& weather) {
  const glm::dvec3 sun = sun_au(place, time, tier);

  SunPosition position;
  position.distance_au = glm::length(sun);
  const double azimuth = std::atan2(sun.x, sun.y);
  position.azimuth_rad = azimuth < 0.0 ? std::fmod(azimuth + 2.0 * std::numbers::pi, 2.0 * std::numbers::pi) : azimuth;
  position.elevation_rad = std::atan2(sun.z, std::hypot(sun.x, sun.y));
  position.apparent_elevation_rad = apparent_elevation(position.elevation_rad, weather);
  position.angular_radius_rad = std::asin(kSunRadiusM / (position.distance_au * kAstronomicalUnitM));
  return position;
}

}  // namespace render
