// What is promised of sun and sky, asked of the program as a user asks it, against the tables of others.

#include <gmock/gmock.h>
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

// Every ninth condition of the table, each in all its directions; luminance relative to the zenith's.
TEST(SkyReference, PerezShapesMatch) {
  const Rows truth = read_table(kData + "sky_reference/perez-reference.csv");
  if (truth.empty()) GTEST_SKIP() << "no reference table";
  std::string csv =
      "utc,lat_deg,lon_deg,view_azimuth_deg,view_elevation_deg,epsilon,delta,sun_elevation_deg,sun_azimuth_deg\n";
  std::vector<double> expected;  // luminance over the zenith's, the zenith first
  int count = 0;
  for (const auto& row : truth) {
    if (row.at("status") != "ok" || ++count % 9 != 0) continue;
    bool valid = true;  // negative somewhere: outside the model's range
    for (const auto& [name, text] : row) valid = valid && (!name.starts_with("L_el") || std::stod(text) > 0.0);
    if (!valid) continue;
    const std::string sun = row.at("epsilon") + ',' + row.at("delta") + ',' + row.at("sun_elev_deg") + ",0\n";
    csv += ",,,0,90," + sun;
    expected.push_back(0.0);
    for (const auto& [name, text] : row) {
      if (!name.starts_with("L_el")) continue;
      const std::size_t split = name.find("_az");
      csv += ",,," + name.substr(split + 3) + ',' + name.substr(4, split - 4) + ',' + sun;
      expected.push_back(std::stod(text) / number(row, "L_el90_az0"));
    }
  }
  const Folder folder;
  const Rows ours =
      table_of(skyshaft({"--quiet", "sky", "--bins", "original", "--batch", folder.write("in.csv", csv)}));
  ASSERT_EQ(ours.size(), expected.size());
  ASSERT_GT(ours.size(), 5000u);
  double zenith = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const double luminance = number(ours[i], "Y");
    if (expected[i] == 0.0) {
      zenith = luminance;
      continue;
    }
    ASSERT_NEAR(luminance / zenith / expected[i], 1.0, 1e-4)
        << ours[i].at("epsilon") << ' ' << ours[i].at("delta") << " sun " << ours[i].at("sun_elevation_deg") << " view "
        << ours[i].at("view_azimuth_deg") << ' ' << ours[i].at("view_elevation_deg");
  }
}

TEST(SkyReference, PreethamMatches) {
  const Rows truth = read_table(kData + "sky_reference/preetham-reference.csv");
  if (truth.empty()) GTEST_SKIP() << "no reference table";
  std::string csv =
      "utc,lat_deg,lon_deg,view_azimuth_deg,view_elevation_deg,turbidity,sun_elevation_deg,sun_azimuth_deg\n";
  for (const auto& row : truth) {
    csv += ",,,";
    csv += row.at("rel_azimuth_deg") + ',' + std::to_string(90.0 - number(row, "view_zenith_deg")) + ',';
    csv += row.at("turbidity") + ',' + std::to_string(90.0 - number(row, "sun_zenith_deg")) + ",0\n";
  }
  const Folder folder;
  const Rows ours = table_of(skyshaft({"sky", "--model", "preetham", "--batch", folder.write("in.csv", csv)}));
  ASSERT_EQ(ours.size(), truth.size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const double sum = number(ours[i], "X") + number(ours[i], "Y") + number(ours[i], "Z");
    ASSERT_NEAR(number(ours[i], "Y") * 1e-3 / number(truth[i], "Y4_kcdm2"), 1.0, 1e-3) << i;
    ASSERT_NEAR(number(ours[i], "X") / sum / number(truth[i], "x4"), 1.0, 1e-3) << i;
    ASSERT_NEAR(number(ours[i], "Y") / sum / number(truth[i], "y4"), 1.0, 1e-3) << i;
  }
}

TEST(SkyReference, CieSkiesMatch) {
  const Rows truth = read_table(kData + "sky_reference/cie-reference.csv");
  if (truth.empty()) GTEST_SKIP() << "no reference table";
  for (int type = 1; type <= 15; ++type) {
    std::string csv = "utc,lat_deg,lon_deg,view_azimuth_deg,view_elevation_deg,sun_elevation_deg,sun_azimuth_deg\n";
    std::vector<double> expected;
    for (const auto& row : truth) {
      if (row.at("type") != std::to_string(type)) continue;
      const std::string sun = std::to_string(90.0 - number(row, "sun_zenith_deg")) + ",0\n";
      csv.append(",,,0,90,").append(sun).append(",,,").append(row.at("rel_azimuth_deg")).append(",");
      csv.append(std::to_string(90.0 - number(row, "view_zenith_deg"))).append(",").append(sun);
      expected.push_back(number(row, "L_over_Lz"));
    }
    const Folder folder;
    const Rows ours =
        table_of(skyshaft({"sky", "--model", "cie:" + std::to_string(type), "--batch", folder.write("in.csv", csv)}));
    ASSERT_EQ(ours.size(), 2 * expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_NEAR(number(ours[2 * i + 1], "Y") / number(ours[2 * i], "Y") / expected[i], 1.0, 1e-4)
          << "type " << type << " row " << i;
    }
  }
}

// RMSE over mean of luminance and root mean square of the distance in u'v' on a day.
struct Disagreement {
  double luminance = 0.0;
  double chromaticity = 0.0;
};

Disagreement on_27_may(const std::vector<std::string>& options) {
  std::string csv = "utc,lat_deg,lon_deg,view_azimuth_deg,view_elevation_deg,sun_elevation_deg,sun_azimuth_deg\n";
  Rows used;
  for (const auto& row : read_table(kData + "sky_measured/kider-sky.csv")) {
    if (!row.at("scan").starts_with("2013-05-27")) continue;
    csv += ",,," + row.at("rel_azimuth_deg") + ',' + row.at("view_elevation_deg") + ',' + row.at("sun_elevation_deg") +
           ",0\n";
    used.push_back(row);
  }
  const Folder folder;
  std::vector<std::string> command{"sky", "--batch", folder.write("in.csv", csv)};
  command.insert(command.end(), options.begin(), options.end());
  const Rows ours = table_of(skyshaft(command));
  EXPECT_EQ(ours.size(), used.size());
  double squared = 0.0;
  double sum = 0.0;
  double color = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    if (used[i].at("flag").find("bad_north") != std::string::npos) continue;
    const double x = number(ours[i], "X");
    const double y = number(ours[i], "Y");
    const double denominator = x + 15.0 * y + 3.0 * number(ours[i], "Z");
    const double measured = number(used[i], "Y_luminance_cdm2");
    squared += (y - measured) * (y - measured);
    sum += measured;
    color += std::pow(4.0 * x / denominator - number(used[i], "u_prime"), 2.0) +
             std::pow(9.0 * y / denominator - number(used[i], "v_prime"), 2.0);
    ++count;
  }
  return {std::sqrt(squared / count) / (sum / count), std::sqrt(color / count)};
}

TEST(SkyReference, MeasuredSkyIsMetWithNothingSaidAndWithItsTurbidity) {
  if (read_table(kData + "sky_measured/kider-sky.csv").empty()) GTEST_SKIP() << "no measured skies";
  EXPECT_LE(on_27_may({}).luminance, 0.21);
  EXPECT_LE(on_27_may({"--turbidity", "2.5"}).luminance, 0.21);
  for (const char* turbidity : {"2.45", "2.5"}) {
    const Disagreement reference = on_27_may({"--model", "reference", "--turbidity", turbidity});
    EXPECT_LE(reference.luminance, 0.19) << turbidity;
    EXPECT_LE(reference.chromaticity, 0.008) << turbidity;
  }
}

TEST(SkyReference, TessellationsAgreeOnTheDiffuseIlluminance) {
  for (const char* elevation : {"8", "60"}) {
    const std::string sun = std::string("140,") + elevation;
    const Result whole = skyshaft({"sky", "--sun", sun});
    const double truth = std::stod(whole.out.substr(whole.out.find("lux:") + 4));
    const auto total = [&](const Rows& rows) {
      double sum = 0.0;
      for (const auto& row : rows) {
        sum += number(row, "projected_sr") *
               (0.2126 * number(row, "r") + 0.7152 * number(row, "g") + 0.0722 * number(row, "b"));
      }
      return sum;
    };
    const Rows fine = table_of(skyshaft({"sky", "--sun", sun, "--patches", "dome5728"}));
    const Rows coarse = table_of(skyshaft({"sky", "--sun", sun, "--patches", "dome144"}));
    const Rows adaptive = table_of(skyshaft({"sky", "--sun", sun, "--patches", "geodesic", "--max-error", "0.005"}));
    EXPECT_EQ(fine.size(), 5728u);
    EXPECT_EQ(coarse.size(), 144u);
    EXPECT_LE(adaptive.size(), 5728u / 5) << elevation;
    EXPECT_NEAR(total(fine) / truth, 1.0, 0.005) << elevation;
    EXPECT_NEAR(total(coarse) / truth, 1.0, 0.03) << elevation;
    EXPECT_NEAR(total(adaptive) / truth, 1.0, 0.005 + 0.001) << elevation;  // the printed total is a sum too
  }
}

// Circular 171 at an elevation, log-linear between its rows.
double circular_lux(const Rows& table, double elevation_deg) {
  for (std::size_t i = 1; i < table.size(); ++i) {
    const double high = number(table[i], "elevation_deg");
    if (high < elevation_deg) continue;
    const double low = number(table[i - 1], "elevation_deg");
    const double weight = (elevation_deg - low) / (high - low);
    return std::pow(number(table[i - 1], "sun_total_horizontal_lux_usno171"), 1.0 - weight) *
           std::pow(number(table[i], "sun_total_horizontal_lux_usno171"), weight);
  }
  return 0.0;
}

// A day and a night at three latitudes, the moon being new.
TEST(SkyReference, IlluminanceFollowsTheObservatorysThroughDayAndNight) {
  const Rows table = read_table(kData + "sky_reference/illuminance-by-elevation.csv");
  if (table.empty()) GTEST_SKIP() << "no reference table";
  int compared = 0;
  for (const char* place : {"0,10", "48.86,10", "69.65,10"}) {
    for (int minute = 0; minute < 24 * 60; minute += 90) {
      char time[32];
      std::snprintf(time, sizeof time, "2024-03-10T%02d:%02d:00Z", minute / 60, minute % 60);
      const std::string out = skyshaft({"sky", "--at", place, "--time", time}).out;
      const double elevation = std::stod(out.substr(out.find("elevation") + 9));
      const double lux = std::stod(out.substr(out.find("gets") + 4));
      ASSERT_TRUE(std::isfinite(lux) && lux > 0.0) << place << ' ' << time;
      if (elevation < -12.0 || elevation > 60.0) continue;
      EXPECT_NEAR(lux / circular_lux(table, elevation), 1.0, 0.2) << place << ' ' << time << " sun " << elevation;
      ++compared;
    }
  }
  EXPECT_GT(compared, 20);
}

TEST(SunAverage, WholeDayOfASouthRoofComesFromTheSouth) {
  const std::vector<std::string> day{"sun",
                                     "--at",
                                     "48.86,2.29",
                                     "--time",
                                     "2024-06-21T03:00:00Z",
                                     "--until",
                                     "2024-06-21T21:00:00Z",
                                     "--step",
                                     "1h",
                                     "--average",
                                     "--plane",
                                     "180,30",
                                     "--format",
                                     "csv"};
  const Rows bins = table_of(skyshaft(day));
  ASSERT_EQ(bins.size(), 144u);
  double south = 0.0;
  double north = 0.0;
  for (const auto& row : bins) {
    const double azimuth = number(row, "azimuth_deg");
    const double lux = number(row, "plane_sky_lux") + number(row, "plane_sun_lux");
    (azimuth > 90.0 && azimuth < 270.0 ? south : north) += lux;
  }
  EXPECT_GT(south, 3.0 * north);
  EXPECT_GT(south + north, 30000.0);  // a long bright day
  EXPECT_LT(south + north, 70000.0);
  EXPECT_EQ(skyshaft({"sun", "--at", "0,0", "--time", "2024-06-21T03:00:00Z", "--average", "--resolution", "7"}).status,
            2);
  EXPECT_EQ(skyshaft({"sun", "--at", "0,0", "--time", "2024-06-21T03:00:00Z", "--average", "--plane", "0,200"}).status,
            2);
}

TEST(SkyRange, WhatLiesOutsideIsSaidOnce) {
  const Folder folder;
  std::string csv = "utc,lat_deg,lon_deg,view_azimuth_deg,view_elevation_deg,turbidity,sun_elevation_deg\n";
  for (int i = 0; i < 5; ++i) csv += ",,,0,45," + std::to_string(20 + i) + ",30\n";
  const Result result = skyshaft({"sky", "--model", "preetham", "--batch", folder.write("in.csv", csv)});
  EXPECT_EQ(result.status, 0);
  const std::size_t first = result.err.find("turbidity");
  EXPECT_NE(first, std::string::npos);
  EXPECT_EQ(result.err.find("turbidity", first + 1), std::string::npos) << result.err;
}

TEST(SkyCube, IsWrittenAsRowsOfSixFaces) {
  const Folder folder;
  for (const char* name : {"cube.exr", "cube.png"}) {
    const std::string out = folder.path(name);
    EXPECT_EQ(skyshaft({"sky", "--sun", "135,32", "--projection", "cube", "--size", "16", "-o", out}).status, 0);
  }
  const Result result =
      skyshaft({"sky", "--sun", "135,32", "--projection", "cube", "--size", "20", "-o", folder.path("other.exr")});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, testing::HasSubstr("power of two"));
}

}  // namespace
}  // namespace cli
