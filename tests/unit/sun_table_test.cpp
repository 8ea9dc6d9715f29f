// `skyshaft sun`: CSV in and out, the diagram.

#include "app/tables/sun_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <numbers>
#include <sstream>

#include "app/report/sun_path_svg.h"
#include "app/tables/csv.h"
#include "ar/error.h"
#include "ar/place/place.h"

namespace {

using ::testing::HasSubstr;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

std::string batch(const std::string& csv, const app::SunTableOptions& options = {}) {
  std::istringstream in(csv);
  std::ostringstream out;
  app::run_sun_batch(in, "in.csv", out, options);
  return out.str();
}

std::string error_of(const std::string& csv) {
  try {
    batch(csv);
  } catch (const ar::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SunBatch, WritesTheGivenColumnsWithTheSunsAndIgnoresOthers) {
  const std::string out = batch("note,utc,lat_deg,lon_deg,height_m\r\n\"a, b\",2024-06-21T12:00:00Z,51.5,0,10\r\n");
  std::istringstream lines(out);
  app::CsvReader csv(lines, "out", {"utc", "azimuth_deg", "illuminance_lux", "r", "g", "b"});
  ASSERT_TRUE(csv.next());
  EXPECT_EQ(csv.text("utc"), "2024-06-21T12:00:00Z");
  EXPECT_EQ(csv.number("height_m"), 10.0);
  EXPECT_NEAR(csv.number("azimuth_deg"), 179.0, 2.0);  // near noon at Greenwich
  EXPECT_NEAR(csv.number("elevation_deg"), 90.0 - 51.5 + 23.44, 0.05);
  EXPECT_GT(csv.number("illuminance_lux"), 60000.0);
  EXPECT_FALSE(csv.has("note"));
  EXPECT_FALSE(csv.next());
}

// edge case 5
TEST(SunBatch, TakesTheLeapSecondLabelAsTheNextSecond) {
  const std::string head = "utc,lat_deg,lon_deg,height_m\n";
  const std::string labelled = batch(head + "2016-12-31T23:59:60Z,0,0,0\n");
  const std::string next = batch(head + "2017-01-01T00:00:00Z,0,0,0\n");
  ASSERT_THAT(labelled, HasSubstr("2016-12-31T23:59:60Z,0,0,0,"));
  EXPECT_EQ(labelled.substr(labelled.find("Z,")), next.substr(next.find("Z,")));
}

// edge case 6
TEST(SunBatch, ReadsOffsetsFromUtc) {
  const std::string head = "utc,lat_deg,lon_deg,height_m\n";
  const std::string utc = batch(head + "2024-06-21T07:30:00Z,48,2,0\n");
  const std::string summer_time = batch(head + "2024-06-21T09:30:00+02:00,48,2,0\n");
  EXPECT_EQ(utc.substr(utc.find(",48,")), summer_time.substr(summer_time.find(",48,")));
}

TEST(SunBatch, NamesFileLineAndColumnOfWhatIsWrong) {
  EXPECT_THAT(error_of("utc,lat_deg,lon_deg\n"), HasSubstr("in.csv:1: no column `height_m`"));
  EXPECT_THAT(error_of("utc,lat_deg,lon_deg,height_m\n2024-01-01T00:00:00Z,x,0,0\n"),
              HasSubstr("in.csv:2: `lat_deg` is `x`"));
  EXPECT_THAT(error_of("utc,lat_deg,lon_deg,height_m\n2024-01-01T00:00:00Z,91,0,0\n"),
              HasSubstr("in.csv:2: lat_deg is 91"));
  EXPECT_THAT(error_of("utc,lat_deg,lon_deg,height_m\nyesterday,0,0,0\n"), HasSubstr("in.csv:2: utc"));
  EXPECT_THAT(error_of("utc,lat_deg,lon_deg,height_m\n2024-01-01T00:00:00Z,0\n"), HasSubstr("in.csv:2: 2 fields"));
  EXPECT_THAT(error_of(""), HasSubstr("in.csv: empty"));
}

TEST(SunBatch, PreciseTierMatchesTheReferenceTable) {
  const std::string path = SKYSHAFT_SHARED_DATA "/sun_positions/sun-positions-public.csv";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
  std::ifstream in(path);
  std::stringstream out;
  app::run_sun_batch(in, path, out, {});
  app::CsvReader ours(out, "ours", {"azimuth_deg"});
  std::ifstream again(path);
  app::CsvReader truth(again, path, {"azimuth_ut1equtc_deg", "elevation_ut1equtc_deg"});
  int rows = 0;
  while (truth.next()) {
    ASSERT_TRUE(ours.next());
    ++rows;
    const auto direction = [](double azimuth_deg, double elevation_deg) {
      const double azimuth = azimuth_deg * kRadPerDeg;
      const double elevation = elevation_deg * kRadPerDeg;
      return glm::dvec3(std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
                        std::sin(elevation));
    };
    const glm::dvec3 a = direction(ours.number("azimuth_deg"), ours.number("elevation_deg"));
    const glm::dvec3 b = direction(truth.number("azimuth_ut1equtc_deg"), truth.number("elevation_ut1equtc_deg"));
    EXPECT_LT(glm::length(a - b) / kRadPerDeg, 1e-4) << truth.where();  // a tenth of what is promised
  }
  EXPECT_EQ(rows, 60);
}

TEST(SunPathDiagram, HasNoPathWhereTheSunStaysDown) {
  const render::Place tromso{69.65 * kRadPerDeg, 18.96 * kRadPerDeg, 0.0};
  std::ostringstream winter;
  app::write_sun_path_svg(winter, tromso, ar::parse_time("2024-12-21T12:00:00Z"), false, render::SunTier::Psa);
  std::ostringstream summer;
  app::write_sun_path_svg(summer, tromso, ar::parse_time("2024-06-21T12:00:00Z"), false, render::SunTier::Psa);
  EXPECT_EQ(winter.str().find("stroke-width=\"2\""), std::string::npos);
  EXPECT_NE(summer.str().find("stroke-width=\"2\""), std::string::npos);
}

}  // namespace
