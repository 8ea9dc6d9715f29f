#include <chrono>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "render/sun/sun_tiers.h"

namespace render {
namespace {

constexpr double kPi = std::numbers::pi;

struct DayAndHour {
  double day_of_year = 1.0;  // 1 on 1 January, 366 on 31 December of a leap year
  double hour = 0.0;         // UTC
};

DayAndHour day_and_hour(UtcTime time) {
  const auto day = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date{day};
  const std::chrono::sys_days new_year{date.year() / std::chrono::January / 1};
  const std::chrono::duration<double, std::ratio<3600>> hour = time - day;
  return {static_cast<double>((day - new_year).count() + 1), hour.count()};
}

}  // namespace

glm::dvec3 daily_sun_au(const Place& place, UtcTime time) {
  const auto [day, hour] = day_and_hour(time);
  const double equation_of_time_h =
      0.170 * std::sin(4.0 * kPi * (day - 80.0) / 373.0) - 0.129 * std::sin(2.0 * kPi * (day - 8.0) / 355.0);
  const double solar_hour = hour + equation_of_time_h + place.longitude_rad * 12.0 / kPi;
  const double declination = 0.4093 * std::sin(2.0 * kPi * (day - 81.0) / 368.0);
  const double hour_angle = kPi * (solar_hour - 12.0) / 12.0;
  // Spencer's first term of the eccentricity correction, (mean distance / distance)^2.
  const double distance_au = 1.0 / std::sqrt(1.0 + 0.033 * std::cos(2.0 * kPi * day / 365.0));

  const double sin_lat = std::sin(place.latitude_rad);
  const double cos_lat = std::cos(place.latitude_rad);
  const double sin_dec = std::sin(declination);
  const double cos_dec = std::cos(declination);
  const glm::dvec3 direction(-cos_dec * std::sin(hour_angle),
                             cos_lat * sin_dec - sin_lat * cos_dec * std::cos(hour_angle),
                             sin_lat * sin_dec + cos_lat * cos_dec * std::cos(hour_angle));
  return distance_au * direction;
}

}  // namespace render
