#include "ar/place/place.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ar {
namespace {

using ::testing::HasSubstr;
using namespace std::chrono_literals;

std::string refusal_of_position(const std::string& text) {
  try {
    parse_position(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

std::string refusal_of_time(const std::string& text) {
  try {
    parse_time(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ParsePosition, TakesTwoNumbersOrThree) {
  const GeoPosition tower = parse_position("48.8584, 2.2945,35");
  EXPECT_EQ(tower.latitude_deg, 48.8584);
  EXPECT_EQ(tower.longitude_deg, 2.2945);
  EXPECT_EQ(tower.height_m, 35.0);
  EXPECT_EQ(parse_position("-33.9,+18.4").height_m, 0.0);
  EXPECT_EQ(parse_position("-90,-180,-430.5").height_m, -430.5);
}

TEST(ParsePosition, SaysWhatIsWrong) {
  EXPECT_THAT(refusal_of_position("91,0"), HasSubstr("latitude 91"));
  EXPECT_THAT(refusal_of_position("0,180.5"), HasSubstr("longitude 180.5"));
  EXPECT_THAT(refusal_of_position("48.8584"), HasSubstr("1 numbers where 2 or 3"));
  EXPECT_THAT(refusal_of_position("48.8584N,2.2945"), HasSubstr("'48.8584N' is no number"));
  EXPECT_THAT(refusal_of_position("48,8584,2,2945"), HasSubstr("4 numbers"));
  for (const char* bad : {"", ",", "nan,0", "inf,0", "1e999,0", "0x10,0", "--1,0", "+-1,0", "1,2,3,"}) {
    EXPECT_NE(refusal_of_position(bad), "accepted") << bad;
  }
}

TEST(ParseIso6709, TakesDegreesMinutesAndSeconds) {
  const auto tower = parse_iso6709("+48.8584+002.2945+035.000/");
  ASSERT_TRUE(tower);
  EXPECT_NEAR(tower->latitude_deg, 48.8584, 1e-12);
  EXPECT_NEAR(tower->longitude_deg, 2.2945, 1e-12);
  EXPECT_NEAR(tower->height_m, 35.0, 1e-12);
  // The standard's own examples: Atlantic Ocean, New York in minutes and in seconds.
  EXPECT_NEAR(parse_iso6709("+00-025/")->longitude_deg, -25.0, 1e-12);
  EXPECT_NEAR(parse_iso6709("+40-075CRSxxxx/")->latitude_deg, 40.0, 1e-12);
  EXPECT_NEAR(parse_iso6709("+4012.22-07500.25/")->latitude_deg, 40.0 + 12.22 / 60.0, 1e-12);
  EXPECT_NEAR(parse_iso6709("+401213.1-0750015.1/")->longitude_deg, -(75.0 + 15.1 / 3600.0), 1e-12);
}

TEST(ParseIso6709, WhatIsNoPositionIsNone) {
  for (const char* bad : {"", "/", "+", "48.8584+002.2945/", "+48.8584", "+91.0+000.0/", "+48.8+181.0/", "+48.8+002.2x",
                          "+4860.0-07500.0/", "+488.0+002.0/", "+nan+000/", "+48.8584+002.2945+abc/"}) {
    EXPECT_FALSE(parse_iso6709(bad)) << bad;
  }
}

TEST(ParseTime, TakesUtcAndOffsets) {
  const UtcTime morning = std::chrono::sys_days(std::chrono::year(2024) / 6 / 21) + 7h + 30min;
  EXPECT_EQ(parse_time("2024-06-21T07:30:00Z"), morning);
  EXPECT_EQ(parse_time("2024-06-21 09:30+02:00"), morning);
  EXPECT_EQ(parse_time("2024-06-21T09:30:00+0200"), morning);
  EXPECT_EQ(parse_time("2024-06-21T13:00:00.000+05:30"), morning);
  EXPECT_EQ(parse_time("2024-06-20T21:30:00.25-10"), morning + 250ms);
  EXPECT_EQ(parse_time("2024-06-21T07:30:00,1234567Z"), morning + 123456us);
  EXPECT_EQ(parse_time("1969-12-31T23:59:59.5Z").time_since_epoch(), -500ms);
}

TEST(ParseTime, TheLeapSecondIsTheSecondAfter) {
  EXPECT_EQ(parse_time("2016-12-31T23:59:60Z"), parse_time("2017-01-01T00:00:00Z"));
  EXPECT_EQ(parse_time("2017-01-01T00:59:60+01:00"), parse_time("2017-01-01T00:00:00Z"));
  EXPECT_THAT(refusal_of_time("2024-06-21T07:30:60Z"), HasSubstr("second 60"));
  EXPECT_THAT(refusal_of_time("2024-03-31T23:59:60Z"), HasSubstr("second 60"));
}

TEST(ParseTime, SaysWhatIsWrong) {
  EXPECT_THAT(refusal_of_time("2024-06-21T07:30:00"), HasSubstr("no time zone"));
  EXPECT_THAT(refusal_of_time("2023-02-29T00:00Z"), HasSubstr("has no day 29"));
  EXPECT_THAT(refusal_of_time("2024-13-01T00:00Z"), HasSubstr("month 13"));
  EXPECT_THAT(refusal_of_time("2024-06-21T24:00Z"), HasSubstr("hour 24"));
  for (const char* bad : {"", "now", "2024-06-21", "24-06-21T00:00Z", "2024-6-21T00:00Z", "2024-06-21T07:30:00ZZ",
                          "2024-06-21T07:30:00+2", "2024-06-21T07:30:00.Z", "2024-06-21T7:30Z", "2024-06-21T07:30:00 Z",
                          "2024-06-21T07:30:00+19:00"}) {
    EXPECT_NE(refusal_of_time(bad), "accepted") << bad;
  }
}

TEST(FormatTime, WritesAFractionOnlyWhereThereIsOne) {
  EXPECT_EQ(format_time(parse_time("2024-06-21T07:30:00Z")), "2024-06-21T07:30:00Z");
  EXPECT_EQ(format_time(parse_time("2024-06-21T07:30:00.250Z")), "2024-06-21T07:30:00.25Z");
  EXPECT_EQ(format_time(parse_time("1969-12-31T23:59:59.000001Z")), "1969-12-31T23:59:59.000001Z");
}

}  // namespace
}  // namespace ar
