#include "render/sun/sun.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "render/sun/refraction.h"

namespace render {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

UtcTime utc(int year, unsigned month, unsigned day, int hour, int minute, double second) {
  const std::chrono::sys_days date = std::chrono::year{year} / std::chrono::month{month} / std::chrono::day{day};
  return date + std::chrono::hours(hour) + std::chrono::minutes(minute) +
         std::chrono::microseconds(static_cast<std::int64_t>(std::llround(second * 1e6)));
}

glm::dvec3 direction(double azimuth_deg, double elevation_deg) {
  SunPosition position;
  position.azimuth_rad = azimuth_deg * kDeg;
  position.elevation_rad = elevation_deg * kDeg;
  return position.direction_in_world();
}

double separation_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / kDeg;
}

TEST(SunPosition, MatchesPublishedSpaExample) {
  // Reda & Andreas 2008, A.5: azimuth 194.340 degrees, zenith angle 50.112 degrees (refracted: 0.016 degrees).
  const Place golden{39.742476 * kDeg, -105.1786 * kDeg, 1830.14};
  const SunPosition sun = sun_position(golden, utc(2003, 10, 17, 19, 30, 30.0));
  EXPECT_NEAR(sun.azimuth_rad / kDeg, 194.340, 1e-3);
  EXPECT_NEAR(sun.elevation_rad / kDeg, 39.872, 1e-3);
}

TEST(SunPosition, PreciseAgreesWithTheReferenceTableEverywhere) {
  std::ifstream file(SKYSHAFT_SHARED_DATA "/sun_positions/sun-positions-public.csv");
  if (!file) GTEST_SKIP() << "reference table is absent";
  std::string line;
  std::getline(file, line);
  int rows = 0;
  while (std::getline(file, line)) {
    std::stringstream stream(line);
    std::vector<std::string> cell;
    for (std::string item; std::getline(stream, item, ',');) cell.push_back(item);
    const std::string& t = cell.at(2);
    const UtcTime time = utc(std::stoi(t.substr(0, 4)), static_cast<unsigned>(std::stoi(t.substr(5, 2))),
                             static_cast<unsigned>(std::stoi(t.substr(8, 2))), std::stoi(t.substr(11, 2)),
                             std::stoi(t.substr(14, 2)), std::stod(t.substr(17)));
    const Place place{std::stod(cell[3]) * kDeg, std::stod(cell[4]) * kDeg, std::stod(cell[5])};
    const SunPosition sun = sun_position(place, time);
    const double error =
        separation_deg(sun.direction_in_world(), direction(std::stod(cell.at(18)), std::stod(cell.at(19))));
    EXPECT_LT(error, 1e-3) << cell[0] << ' ' << cell[1];
    // 2e-6 au is what the distance changes by while the light is on its way
    EXPECT_NEAR(sun.distance_au, std::stod(cell[14]), 2e-6) << cell[0];
    ++rows;
  }
  EXPECT_GE(rows, 60);
}

TEST(SunLight, IsWhiteAndStrongAtNoonRedAtTheHorizonAndGoneBelow) {
  SunPosition sun;
  sun.elevation_rad = sun.apparent_elevation_rad = 60.0 * kDeg;
  const glm::dvec3 noon = sun_light(sun, 2.5).illuminance_rgb;
  EXPECT_NEAR(glm::dot(noon, glm::dvec3(0.2126, 0.7152, 0.0722)), 1e5, 1.5e4);  // a clear noon, klux
  EXPECT_GT(noon.b / noon.r, 0.65);
  sun.elevation_rad = sun.apparent_elevation_rad = 2.0 * kDeg;
  const glm::dvec3 low = sun_light(sun, 2.5).illuminance_rgb;
  EXPECT_LT(low.b / low.r, 0.3);
  EXPECT_GE(low.b, 0.0);
  sun.apparent_elevation_rad = -0.3 * kDeg;
  EXPECT_EQ(sun_light(sun, 2.5).illuminance_rgb, glm::dvec3(0.0));
  sun.apparent_elevation_rad = 0.0;
  EXPECT_DOUBLE_EQ(sun_light(sun, 2.5).visible_disc_fraction, 0.5);
}

TEST(Refraction, LiftsAsPublishedAndRisesMonotonically) {
  const Weather standard{1010.0, 10.0};
  EXPECT_NEAR(apparent_elevation(0.0, standard) / kDeg * 60.0, 28.98, 0.01);  // Saemundsson at the horizon
  EXPECT_EQ(apparent_elevation(-6.0 * kDeg, standard), -6.0 * kDeg);
  EXPECT_EQ(apparent_elevation(90.0 * kDeg, standard), 90.0 * kDeg);
  for (const Weather weather : {standard, Weather{1080.0, -60.0}, Weather{300.0, 45.0}}) {
    double before = -1e9;
    for (double elevation_deg = -90.0; elevation_deg <= 90.0; elevation_deg += 0.01) {
      const double apparent = apparent_elevation(elevation_deg * kDeg, weather);
      ASSERT_GT(apparent, before) << elevation_deg;
      before = apparent;
    }
  }
}

}  // namespace
}  // namespace render
