#include "render/sky/moon.h"

#include <erfa.h>
#include <erfam.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/sky/twilight.h"
#include "render/sun/refraction.h"

namespace render {
namespace {

constexpr double kAstronomicalUnitM = 149597870700.0;

glm::dvec3 column(const double v[3]) {
  return {v[0], v[1], v[2]};
}

struct Bodies {
  glm::dvec3 moon_m;  // from the Earth's centre, in terrestrial coordinates
  glm::dvec3 sun_m;
};

Bodies geocentric(UtcTime time) {
  const auto midnight = std::chrono::floor<std::chrono::days>(time);
  const double day = 2440587.5 + static_cast<double>(midnight.time_since_epoch().count());
  const std::chrono::duration<double, std::ratio<86400>> fraction = time - midnight;
  double tai[2];
  double tt[2];
  eraUtctai(day, fraction.count(), &tai[0], &tai[1]);
  eraTaitt(tai[0], tai[1], &tt[0], &tt[1]);

  double moon[2][3];
  eraMoon98(tt[0], tt[1], moon);
  double heliocentric[2][3];
  double barycentric[2][3];
  eraEpv00(tt[0], tt[1], heliocentric, barycentric);
  double matrix[3][3];
  eraC2t06a(tt[0], tt[1], day, fraction.count(), 0.0, 0.0, matrix);
  double sun[3] = {-heliocentric[0][0], -heliocentric[0][1], -heliocentric[0][2]};
  double moon_turned[3];
  double sun_turned[3];
  eraRxp(matrix, moon[0], moon_turned);
  eraRxp(matrix, sun, sun_turned);
  return {column(moon_turned) * kAstronomicalUnitM, column(sun_turned) * kAstronomicalUnitM};
}

}  // namespace

glm::dvec3 MoonPosition::apparent_direction_in_world() const {
  return as_sun(*this).apparent_direction_in_world();
}

MoonPosition moon_position(const Place& place, UtcTime time, const Weather& weather) {
  const Bodies bodies = geocentric(time);
  double site[3];
  eraGd2gc(ERFA_WGS84, place.longitude_rad, place.latitude_rad, place.height_m, site);
  const glm::dvec3 moon = bodies.moon_m - column(site);
  const glm::dvec3 sun_from_moon = bodies.sun_m - bodies.moon_m;

  const double sin_lat = std::sin(place.latitude_rad);
  const double cos_lat = std::cos(place.latitude_rad);
  const double sin_lon = std::sin(place.longitude_rad);
  const double cos_lon = std::cos(place.longitude_rad);
  const double east = glm::dot(moon, glm::dvec3(-sin_lon, cos_lon, 0.0));
  const double north = glm::dot(moon, glm::dvec3(-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat));
  const double up = glm::dot(moon, glm::dvec3(cos_lat * cos_lon, cos_lat * sin_lon, sin_lat));

  MoonPosition position;
  const double azimuth = std::atan2(east, north);
  position.azimuth_rad = azimuth < 0.0 ? azimuth + 2.0 * std::numbers::pi : azimuth;
  position.elevation_rad = std::atan2(up, std::hypot(east, north));
  position.apparent_elevation_rad = apparent_elevation(position.elevation_rad, weather);
  position.distance_m = glm::length(moon);
  const double cosine = glm::dot(glm::normalize(sun_from_moon), glm::normalize(-moon));
  position.phase_angle_rad = std::acos(std::clamp(cosine, -1.0, 1.0));
  position.illuminated_fraction = 0.5 * (1.0 + cosine);
  return position;
}

double moon_to_sun(const MoonPosition& moon) {
  return moon_illuminance_lux(moon.elevation_rad, moon.phase_angle_rad, moon.distance_m) /
         clear_illuminance_lux(moon.elevation_rad);
}

SunPosition as_sun(const MoonPosition& moon) {
  SunPosition sun;
  sun.azimuth_rad = moon.azimuth_rad;
  sun.elevation_rad = moon.elevation_rad;
  sun.apparent_elevation_rad = moon.apparent_elevation_rad;
  return sun;
}

glm::dvec3 moon_illuminance_rgb(const MoonPosition& moon, double turbidity) {
  return sun_light(as_sun(moon), turbidity).illuminance_rgb * moon_to_sun(moon);
}

}  // namespace render
