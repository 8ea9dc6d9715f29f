#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <sstream>

#include "app/tables/csv.h"
#include "app/tables/sky_request.h"
#include "app/tables/sun_average_table.h"
#include "render/sky/hemisphere.h"
#include "render/sun/spectrum.h"

namespace {

using namespace std::chrono_literals;
using std::chrono::sys_days;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

render::AverageRequest midsummer(std::chrono::microseconds length, std::chrono::microseconds step) {
  render::AverageRequest request;
  request.place = {48.86 * kRadPerDeg, 2.29 * kRadPerDeg, 0.0};
  request.first = sys_days{std::chrono::year{2024} / 6 / 21} + 9h;
  request.last = request.first + length;
  request.step = step;
  return request;
}

double lux(const glm::dvec3& rgb) {
  return render::luminance(rgb);
}

TEST(SunAverage, OneInstantIsThatInstantsLight) {
  const render::AverageRequest request = midsummer(0s, 1h);
  const render::AverageLight light = render::average_light(request);
  app::SunRequest now;
  now.place = request.place;
  now.time = request.first;
  const render::Daylight expected = app::answer(now, request.sky);
  EXPECT_EQ(light.instants, 1);
  EXPECT_NEAR(lux(light.sun_illuminance_rgb),
              lux(expected.sun_illuminance_rgb) * std::sin(expected.sun.apparent_elevation_rad), 1e-6);
  const double sky = lux(render::horizontal_illuminance(*expected.sky));
  EXPECT_NEAR(lux(light.sky_illuminance_rgb) / sky, 1.0, 0.01);  // samples 4 degrees apart
}

TEST(SunAverage, MeanIsTakenByTheTrapezoidRule) {
  const auto at = [](std::chrono::microseconds after) {
    render::AverageRequest request = midsummer(0s, 1h);
    request.first = request.last = request.first + after;
    return lux(render::average_light(request).sun_illuminance_rgb);
  };
  const render::AverageLight light = render::average_light(midsummer(2h, 1h));
  EXPECT_EQ(light.instants, 3);
  EXPECT_DOUBLE_EQ(light.hours, 2.0);
  EXPECT_NEAR(lux(light.sun_illuminance_rgb), 0.25 * at(0h) + 0.5 * at(1h) + 0.25 * at(2h), 1e-6);
}

TEST(SunAverage, BinsTileTheSkyAndSumToTheTotals) {
  for (const double bin_deg : {5.0, 15.0, 45.0, 90.0}) {
    render::AverageRequest request = midsummer(4h, 30min);
    request.bin_deg = bin_deg;
    request.plane = {200.0 * kRadPerDeg, 60.0 * kRadPerDeg};
    const render::AverageLight light = render::average_light(request);
    double solid_angle = 0.0;
    double sky = 0.0;
    double sun = 0.0;
    for (const render::DirectionBin& bin : light.bins) {
      solid_angle += bin.solid_angle_sr;
      sky += bin.plane_sky_lux;
      sun += bin.plane_sun_lux;
    }
    EXPECT_EQ(light.bins.size(), static_cast<std::size_t>(std::lround(360.0 / bin_deg * 90.0 / bin_deg)));
    EXPECT_NEAR(solid_angle, 2.0 * std::numbers::pi, 1e-9) << bin_deg;
    EXPECT_NEAR(sky / lux(light.sky_illuminance_rgb), 1.0, 1e-9) << bin_deg;
    EXPECT_NEAR(sun / lux(light.sun_illuminance_rgb), 1.0, 1e-9) << bin_deg;
  }
}

TEST(SunAverage, TotalsDoNotDependOnTheBins) {
  render::AverageRequest coarse = midsummer(4h, 1h);
  coarse.plane = {120.0 * kRadPerDeg, 90.0 * kRadPerDeg};
  render::AverageRequest fine = coarse;
  coarse.bin_deg = 30.0;
  fine.bin_deg = 2.0;
  EXPECT_NEAR(
      lux(render::average_light(coarse).sky_illuminance_rgb) / lux(render::average_light(fine).sky_illuminance_rgb),
      1.0, 0.01);
}

TEST(SunAverage, WallsGetTheSunOfTheirOwnSide) {
  render::AverageRequest request = midsummer(0s, 1h);
  request.first = request.last = sys_days{std::chrono::year{2024} / 6 / 21} + 6h;  // the sun stands in the east
  request.plane = {90.0 * kRadPerDeg, 90.0 * kRadPerDeg};
  const render::AverageLight east = render::average_light(request);
  request.plane.azimuth_rad = 270.0 * kRadPerDeg;
  const render::AverageLight west = render::average_light(request);
  EXPECT_GT(lux(east.sun_illuminance_rgb), 10000.0);
  EXPECT_EQ(lux(west.sun_illuminance_rgb), 0.0);
  EXPECT_GT(lux(east.sky_illuminance_rgb), 2.0 * lux(west.sky_illuminance_rgb));
  request.plane.tilt_rad = 180.0 * kRadPerDeg;
  EXPECT_NEAR(lux(render::average_light(request).sky_illuminance_rgb), 0.0, 1e-6);  // it looks down
}

TEST(SunAverage, TablesHoldEveryBin) {
  const render::AverageLight light = render::average_light(midsummer(1h, 30min));
  std::stringstream out;
  app::write_average_csv(out, light);
  app::CsvReader csv(
      out, "average",
      {"azimuth_deg", "elevation_deg", "solid_angle_sr", "sky_r", "sun_r", "plane_sky_lux", "plane_sun_lux"});
  double sum = 0.0;
  int rows = 0;
  while (csv.next()) {
    sum += csv.number("plane_sky_lux") + csv.number("plane_sun_lux");
    ++rows;
  }
  EXPECT_EQ(rows, 144);
  EXPECT_NEAR(sum / lux(light.sky_illuminance_rgb + light.sun_illuminance_rgb), 1.0, 1e-6);
  std::ostringstream json;
  app::write_average_json(json, light);
  EXPECT_THAT(json.str(), ::testing::HasSubstr("\"mean_illuminance_lux\""));
}

}  // namespace
