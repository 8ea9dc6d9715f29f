// The sky as a user asks for it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/testing/run_program.h"

namespace cli {
namespace {

using ::testing::HasSubstr;

TEST(Sky, BatchKeepsItsColumnsAndAddsTheSky) {
  const Folder folder;
  const std::string in = folder.write("in.csv",
                                      "utc,lat_deg,lon_deg,view_azimuth_deg,view_elevation_deg,turbidity\n"
                                      "2024-06-21T10:00:00Z,48.85,2.29,180,45,3\n"
                                      "2024-06-21T10:00:00Z,48.85,2.29,0,20,\n");
  const Result result = skyshaft({"sky", "--batch", in});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto rows = read_csv(folder.write("out.csv", result.out));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_THAT(rows[0], testing::ElementsAre("utc", "lat_deg", "lon_deg", "view_azimuth_deg", "view_elevation_deg",
                                            "turbidity", "X", "Y", "Z", "sun_angle_deg"));
  EXPECT_EQ(rows[1][0], "2024-06-21T10:00:00Z");
  EXPECT_GT(std::stod(rows[1][7]), 1000.0);  // cd/m2 of a clear June sky
  EXPECT_LT(std::stod(rows[1][7]), 20000.0);
  EXPECT_GT(std::stod(rows[2][9]), 60.0);
}

TEST(Sky, BatchTakesTheSunAndTheConditionAsGiven) {
  const Folder folder;
  const std::string in =
      folder.write("in.csv",
                   "utc,lat_deg,lon_deg,view_azimuth_deg,view_elevation_deg,epsilon,delta,sun_elevation_deg,"
                   "sun_azimuth_deg\n,,,90,30,1.3,0.3,30,90\n");
  const Result result = skyshaft({"sky", "--bins", "original", "--batch", in});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto rows = read_csv(folder.write("out.csv", result.out));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_NEAR(std::stod(rows[1].back()), 0.0, 1e-3);
}

TEST(Sky, BadRowNamesFileLineAndColumn) {
  const Folder folder;
  const std::string in = folder.write("in.csv",
                                      "utc,lat_deg,lon_deg,view_azimuth_deg,view_elevation_deg\n"
                                      "2024-06-21T10:00:00Z,95,2.29,180,45\n");
  const Result result = skyshaft({"sky", "--batch", in});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.err, HasSubstr("in.csv:2"));
  EXPECT_THAT(result.err, HasSubstr("lat_deg"));
}

TEST(Sky, PictureIsWrittenWholeAndNotOverwritten) {
  const Folder folder;
  for (const char* name : {"sky.png", "sky.exr", "sky.hdr"}) {
    const std::string out = folder.path(name);
    EXPECT_EQ(skyshaft({"sky", "--sun", "135,32", "--size", "32", "-o", out}).status, 0) << name;
    EXPECT_GT(std::filesystem::file_size(out), 100u) << name;
    EXPECT_EQ(skyshaft({"sky", "--sun", "135,32", "--size", "32", "-o", out}).status, 1) << name;
  }
  EXPECT_EQ(skyshaft({"sky", "--sun", "135,32", "-o", folder.path("sky.gif")}).status, 2);
  EXPECT_EQ(folder.names().size(), 3u);
}

// A picture of the sky read back as a sky gives the same light, its sun's disc taken out.
TEST(Sky, PictureServesAsASky) {
  const Folder folder;
  const std::string out = folder.path("sky.exr");
  ASSERT_EQ(skyshaft({"sky", "--sun", "135,32", "--projection", "latlong", "--size", "256", "-o", out}).status, 0);
  const Result drawn = skyshaft({"sky", "--sun", "135,32", "--direction", "0,60", "--format", "csv"});
  const Result read =
      skyshaft({"sky", "--sun", "135,32", "--model", "image:" + out, "--direction", "0,60", "--format", "csv"});
  ASSERT_EQ(read.status, 0) << read.err;
  const auto luminance = [&](const Result& result) {
    return std::stod(read_csv(folder.write("view.csv", result.out))[1][3]);
  };
  EXPECT_NEAR(luminance(read) / luminance(drawn), 1.0, 0.15);  // levels of two clear-sky models
}

TEST(Sky, WrongUsageIsStatus2) {
  EXPECT_EQ(skyshaft({"sky", "--direction", "0,45"}).status, 2);
  EXPECT_EQ(skyshaft({"sky", "--sun", "0,30", "--direction", "north"}).status, 2);
  const Result result = skyshaft({"sky", "--sun", "0,30", "--model", "green"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("reference"));
}

}  // namespace
}  // namespace cli
