// What is promised of the sun's place, asked of the program as a user asks it, against published positions.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/testing/run_program.h"
#include "tests/testing/table.h"

namespace cli {
namespace {

using Rows = std::vector<std::map<std::string, std::string>>;

constexpr double kDeg = std::numbers::pi / 180.0;
const std::string kData = SKYSHAFT_SHARED_DATA "/";

double number(const std::map<std::string, std::string>& row, const std::string& name) {
  return std::stod(row.at(name));
}

// Standard output as a table.
Rows table_of(const Result& result) {
  EXPECT_EQ(result.status, 0) << result.err;
  const Folder folder;
  return read_table(folder.write("out.csv", result.out));
}

double separation_deg(double azimuth_a, double elevation_a, double azimuth_b, double elevation_b) {
  const double half_elevation = std::sin(0.5 * (elevation_a - elevation_b) * kDeg);
  const double half_azimuth = std::sin(0.5 * (azimuth_a - azimuth_b) * kDeg);
  return 2.0 *
         std::asin(
             std::sqrt(half_elevation * half_elevation +
                       std::cos(elevation_a * kDeg) * std::cos(elevation_b * kDeg) * half_azimuth * half_azimuth)) /
         kDeg;
}

// Largest error of a tier over the published positions, degrees.
double worst_error_deg(const std::string& tier) {
  const std::string file = kData + "sun_positions/sun-positions-public.csv";
  const Rows truth = read_table(file);
  const Rows ours = table_of(skyshaft({"sun", "--tier", tier, "--batch", file}));
  EXPECT_EQ(ours.size(), truth.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    worst = std::max(
        worst, separation_deg(number(ours[i], "azimuth_deg"), number(ours[i], "elevation_deg"),
                              number(truth[i], "azimuth_ut1equtc_deg"), number(truth[i], "elevation_ut1equtc_deg")));
  }
  return worst;
}

TEST(SunReference, BatchMeetsThePublishedPositionsInEveryTier) {
  if (read_table(kData + "sun_positions/sun-positions-public.csv").empty()) GTEST_SKIP() << "no reference table";
  EXPECT_LE(worst_error_deg("precise"), 0.001);
  EXPECT_LE(worst_error_deg("psa"), 0.012);
  EXPECT_LE(worst_error_deg("daily"), 1.4);
}

TEST(SunReference, BatchIsFiniteWhereItBreaksElsewhere) {
  const Folder folder;
  std::string csv = "utc,lat_deg,lon_deg,height_m\n";
  for (const char* time : {"2016-12-31T23:59:60Z", "2024-02-29T12:00:00Z", "2100-03-01T00:00:00Z",
                           "2024-12-31T23:59:59Z", "1900-01-01T00:00:00Z"}) {
    for (const char* latitude : {"-90", "-89.9", "0", "23.4", "90"}) {
      for (const char* longitude : {"-180", "0", "179.999999", "180"}) {
        csv += std::string(time) + ',' + latitude + ',' + longitude + ",0\n";
      }
    }
  }
  const std::string in = folder.write("in.csv", csv);
  for (const char* tier : {"daily", "psa", "precise"}) {
    const Rows rows = table_of(skyshaft({"sun", "--tier", tier, "--batch", in}));
    ASSERT_EQ(rows.size(), 100u);
    for (const auto& row : rows) {
      for (const char* column : {"azimuth_deg", "elevation_deg", "apparent_elevation_deg", "illuminance_lux", "r"}) {
        ASSERT_TRUE(std::isfinite(number(row, column))) << tier << ' ' << row.at("utc") << ' ' << column;
      }
    }
  }
}

}  // namespace
}  // namespace cli
