#include <erfa.h>
#include <erfam.h>

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/sun/sun_tiers.h"

namespace render {
namespace {

constexpr double kLightAuPerDay = 173.14463267424034;
constexpr double kEarthTurnRadPerDay = 6.300388098984957;  // IERS Conventions 2010: 7.292115e-5 rad/s

// A Julian date in two parts, so that microseconds survive.
struct JulianDate {
  double day = 0.0;
  double fraction = 0.0;
};

JulianDate utc_julian_date(UtcTime time) {
  const auto midnight = std::chrono::floor<std::chrono::days>(time);
  const double days = static_cast<double>(midnight.time_since_epoch().count());
  const std::chrono::duration<double, std::ratio<86400>> fraction = time - midnight;
  return {2440587.5 + days, fraction.count()};
}

JulianDate terrestrial_time(const JulianDate& utc) {
  JulianDate tai;
  JulianDate tt;
  eraUtctai(utc.day, utc.fraction, &tai.day, &tai.fraction);  // warns of years outside the leap second table only
  eraTaitt(tai.day, tai.fraction, &tt.day, &tt.fraction);
  return tt;
}

glm::dvec3 column(const double v[3]) {
  return {v[0], v[1], v[2]};
}

// Vector from the Earth's centre to the sun as it was when its light left, aberrated by the Earth's motion; au in the
// celestial frame (GCRS).
glm::dvec3 geocentric_sun_au(const JulianDate& tt) {
  double heliocentric[2][3];
  double barycentric[2][3];
  eraEpv00(tt.day, tt.fraction, heliocentric, barycentric);
  const glm::dvec3 earth = column(barycentric[0]);
  const double light_days = glm::length(column(heliocentric[0])) / kLightAuPerDay;

  // About the barycentre the sun moves 5e-8 au while its light travels: straight enough.
  const glm::dvec3 sun_velocity = column(barycentric[1]) - column(heliocentric[1]);
  const glm::dvec3 sun_then = column(barycentric[0]) - column(heliocentric[0]) - light_days * sun_velocity;
  const glm::dvec3 sun = sun_then - earth;
  const double distance_au = glm::length(sun);

  double natural[3] = {sun.x / distance_au, sun.y / distance_au, sun.z / distance_au};
  double velocity[3];
  for (int i = 0; i < 3; ++i) velocity[i] = barycentric[1][i] / kLightAuPerDay;
  const glm::dvec3 beta(velocity[0], velocity[1], velocity[2]);
  double proper[3];
  eraAb(natural, velocity, distance_au, std::sqrt(1.0 - glm::dot(beta, beta)), proper);
  return distance_au * column(proper);
}

// Rotates celestial (GCRS) into terrestrial coordinates, polar motion zero. IAU 2000B is within 0.003 arc seconds of
// the full IAU 2006/2000A from 1950 to 2100, at a tenth of its cost.
glm::dvec3 terrestrial_from_celestial(const glm::dvec3& x_in_celestial, const JulianDate& ut1, const JulianDate& tt) {
  double matrix[3][3];
  double no_motion_x = 0.0;
  double no_motion_y = 0.0;
  eraC2t00b(tt.day, tt.fraction, ut1.day, ut1.fraction, no_motion_x, no_motion_y, matrix);
  double in[3] = {x_in_celestial.x, x_in_celestial.y, x_in_celestial.z};
  double out[3];
  eraRxp(matrix, in, out);
  return column(out);
}

// Vector from `place` to the sun in east, north, up; au. Adds the parallax and the aberration of the Earth's turning.
glm::dvec3 topocentric(const glm::dvec3& sun_in_earth_au, const Place& place) {
  double site[3];
  eraGd2gc(ERFA_WGS84, place.longitude_rad, place.latitude_rad, place.height_m, site);
  const glm::dvec3 site_au = column(site) / ERFA_DAU;
  glm::dvec3 sun = sun_in_earth_au - site_au;
  const glm::dvec3 site_velocity = kEarthTurnRadPerDay * glm::dvec3(-site_au.y, site_au.x, 0.0);
  sun += glm::length(sun) * site_velocity / kLightAuPerDay;

  const double sin_lat = std::sin(place.latitude_rad);
  const double cos_lat = std::cos(place.latitude_rad);
  const double sin_lon = std::sin(place.longitude_rad);
  const double cos_lon = std::cos(place.longitude_rad);
  const glm::dvec3 east(-sin_lon, cos_lon, 0.0);
  const glm::dvec3 north(-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat);
  const glm::dvec3 up(cos_lat * cos_lon, cos_lat * sin_lon, sin_lat);
  return {glm::dot(sun, east), glm::dot(sun, north), glm::dot(sun, up)};
}

}  // namespace

glm::dvec3 precise_sun_au(const Place& place, UtcTime time) {
  const JulianDate utc = utc_julian_date(time);
  const JulianDate tt = terrestrial_time(utc);
  return topocentric(terrestrial_from_celestial(geocentric_sun_au(tt), utc, tt), place);
}

}  // namespace render
