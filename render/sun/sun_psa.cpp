#include <chrono>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "render/sun/sun_tiers.h"

namespace render {
namespace {

constexpr double kRadPerHour = std::numbers::pi / 12.0;
constexpr double kEarthRadiusAu = 6371.01 / 149597890.0;

// Days since 2000-01-01 12:00 UTC, and the hours of the UTC day.
struct Epoch {
  double days = 0.0;
  double hour = 0.0;
};

Epoch epoch_of(UtcTime time) {
  using namespace std::chrono;
  constexpr sys_days kJ2000Midnight{2000y / January / 1};
  const auto midnight = floor<days>(time);
  const duration<double, std::ratio<3600>> hour = time - midnight;
  return {static_cast<double>((midnight - kJ2000Midnight).count()) - 0.5 + hour.count() / 24.0, hour.count()};
}

}  // namespace

// Names and constants as in table 1 of the paper.
glm::dvec3 psa_sun_au(const Place& place, UtcTime time) {
  const auto [n, hour] = epoch_of(time);
  const double omega = 2.267127827 - 9.300339267e-4 * n;
  const double mean_longitude = 4.895036035 + 1.720279602e-2 * n;
  const double mean_anomaly = 6.239468336 + 1.720200135e-2 * n;
  const double ecliptic_longitude = mean_longitude + 3.338320972e-2 * std::sin(mean_anomaly) +
                                    3.497596876e-4 * std::sin(2.0 * mean_anomaly) - 1.544353226e-4 -
                                    8.689729360e-6 * std::sin(omega);
  const double obliquity = 4.090904909e-1 - 6.213605399e-9 * n + 4.418094944e-5 * std::cos(omega);
  const double sidereal_rad = (6.697096103 + 6.570984737e-2 * n + hour) * kRadPerHour + place.longitude_rad;
  // Distance: the Astronomical Almanac's low-precision formula.
  const double distance_au = 1.00014 - 0.01671 * std::cos(mean_anomaly) - 0.00014 * std::cos(2.0 * mean_anomaly);

  // Equatorial axes turned by the sidereal time: x towards the local meridian, y to the east, z to the pole.
  const double equator_x = std::cos(ecliptic_longitude);
  const double equator_y = std::cos(obliquity) * std::sin(ecliptic_longitude);
  const double pole = std::sin(obliquity) * std::sin(ecliptic_longitude);
  const double cos_st = std::cos(sidereal_rad);
  const double sin_st = std::sin(sidereal_rad);
  const double meridian = cos_st * equator_x + sin_st * equator_y;
  const double east = cos_st * equator_y - sin_st * equator_x;

  const double sin_lat = std::sin(place.latitude_rad);
  const double cos_lat = std::cos(place.latitude_rad);
  const glm::dvec3 from_centre =
      distance_au * glm::dvec3(east, cos_lat * pole - sin_lat * meridian, sin_lat * pole + cos_lat * meridian);
  return from_centre - glm::dvec3(0.0, 0.0, kEarthRadiusAu);
}

}  // namespace render
