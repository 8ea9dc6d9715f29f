// Where and when, as containers and cameras write it.

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <utility>

#include "ar/capture/file/metadata.h"
#include "ar/place/place.h"

namespace ar {
namespace {

class Tags {
 public:
  explicit Tags(std::initializer_list<std::pair<std::string, std::string>> tags) {
    for (const auto& [key, value] : tags) dict_.set(key, value);
  }
  const AVDictionary* get() { return *dict_.out(); }

 private:
  ffmpeg::Dictionary dict_;
};

TEST(RecordedAt, ReadsCreationTimeAndIso6709) {
  Tags tags({{"creation_time", "2018-10-23T19:10:20.500000Z"}, {"location", "+48.8584+002.2945+035.000/"}});
  const RecordedAt at = recorded_at(tags.get());
  ASSERT_TRUE(at.time && at.latitude_deg && at.longitude_deg && at.height_m);
  EXPECT_EQ(*at.time, parse_time("2018-10-23T19:10:20.5Z"));
  EXPECT_DOUBLE_EQ(*at.latitude_deg, 48.8584);
  EXPECT_DOUBLE_EQ(*at.longitude_deg, 2.2945);
  EXPECT_DOUBLE_EQ(*at.height_m, 35.0);
}

TEST(RecordedAt, ApplesOwnKeysComeFirst) {
  Tags tags({{"creation_time", "2020-05-01T10:30:00.000000Z"},
             {"com.apple.quicktime.creationdate", "2020-05-01T12:00:00+0200"},
             {"location", "+01.0000+002.0000/"},
             {"com.apple.quicktime.location.ISO6709", "-33.8568+151.2153+005.0/"}});
  const RecordedAt at = recorded_at(tags.get());
  EXPECT_EQ(at.time, parse_time("2020-05-01T10:00:00Z"));
  EXPECT_EQ(at.latitude_deg, -33.8568);
  EXPECT_EQ(at.longitude_deg, 151.2153);
}

TEST(RecordedAt, ALocalTimeWithoutZoneOrNonsenseTellsNothing) {
  for (const char* text : {"2020-05-01T12:00:00", "yesterday", "2020-13-41T12:00:00Z", ""}) {
    Tags tags({{"creation_time", text}, {"location", "somewhere"}});
    const RecordedAt at = recorded_at(tags.get());
    EXPECT_FALSE(at.time) << text;
    EXPECT_FALSE(at.latitude_deg);
  }
}

TEST(RecordedAt, ReadsThePositionAndGpsTimeOfAStill) {
  Tags tags({{"GPSLatitude", "     33:1,      51:1,    2448:100 "},
             {"GPSLatitudeRef", "S"},
             {"GPSLongitude", "151:1, 12:1, 55:1"},
             {"GPSLongitudeRef", "E"},
             {"GPSAltitude", "525:100"},
             {"GPSDateStamp", "2011:10:15"},
             {"GPSTimeStamp", "9:1, 5:1, 125:10"}});
  const RecordedAt at = recorded_at(tags.get());
  EXPECT_NEAR(at.latitude_deg.value(), -(33 + 51 / 60.0 + 24.48 / 3600.0), 1e-12);
  EXPECT_NEAR(at.longitude_deg.value(), 151 + 12 / 60.0 + 55 / 3600.0, 1e-12);
  EXPECT_NEAR(at.height_m.value(), 5.25, 1e-12);
  EXPECT_EQ(at.time, parse_time("2011-10-15T09:05:12.5Z"));
}

TEST(RecordedAt, ReadsAStillsOwnClockOnlyWithItsOffset) {
  Tags with({{"DateTimeOriginal", "2022:06:21 09:30:00"}, {"OffsetTimeOriginal", "+02:00"}});
  EXPECT_EQ(recorded_at(with.get()).time, parse_time("2022-06-21T07:30:00Z"));
  Tags without({{"DateTimeOriginal", "2022:06:21 09:30:00"}});
  EXPECT_FALSE(recorded_at(without.get()).time);
}

TEST(Exposure, ReadsRationals) {
  Tags tags({{"ExposureTime", "      1:250   "}, {"FNumber", "18:10"}, {"ISOSpeedRatings", "    64"}});
  const ExposureInfo exposure = exposure_of(tags.get());
  EXPECT_DOUBLE_EQ(exposure.exposure_s.value(), 0.004);
  EXPECT_DOUBLE_EQ(exposure.f_number.value(), 1.8);
  EXPECT_DOUBLE_EQ(exposure.iso.value(), 64.0);
}

TEST(Metadata, WhatIsWrittenReadsBack) {
  const auto time = parse_time("2024-06-21T07:30:00.25Z");
  for (const double latitude : {0.0, 48.858412, -33.5, 89.999999, -90.0}) {
    Tags tags({{"creation_time", iso8601(time)}, {"location", iso6709(latitude, -2.294501, -12.5)}});
    const RecordedAt at = recorded_at(tags.get());
    EXPECT_EQ(at.time, time);
    EXPECT_NEAR(at.latitude_deg.value(), latitude, 1e-9);
    EXPECT_NEAR(at.longitude_deg.value(), -2.294501, 1e-9);
    EXPECT_NEAR(at.height_m.value(), -12.5, 1e-9);
  }
}

}  // namespace
}  // namespace ar
