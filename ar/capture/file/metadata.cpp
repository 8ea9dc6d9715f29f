#include "ar/capture/file/metadata.h"

#include <fmt/format.h>

extern "C" {
#include <libavutil/parseutils.h>
}

#include <array>
#include <cmath>
#include <regex>
#include <vector>

#include "ar/place/place.h"

namespace ar {
namespace {

using Microseconds = std::chrono::sys_time<std::chrono::microseconds>;

// Only with a zone at its end: a local time of an unknown place tells no instant.
std::optional<Microseconds> parse_instant(const std::string& text) {
  static const std::regex with_zone(R"(.*\d(Z|[+-]\d\d:?\d\d)\s*)");
  std::int64_t microseconds = 0;
  if (!std::regex_match(text, with_zone) || av_parse_time(&microseconds, text.c_str(), 0) < 0) return std::nullopt;
  return Microseconds(std::chrono::microseconds(microseconds));
}

// The numbers in EXIF's rationals as FFmpeg prints them: "48:1, 51:1, 3024:100" is {48, 51, 30.24}.
std::vector<double> rationals(const std::string& text) {
  static const std::regex rational(R"((\d+)\s*:\s*(\d+))");
  std::vector<double> values;
  for (std::sregex_iterator it(text.begin(), text.end(), rational), end; it != end; ++it) {
    const double denominator = std::stod((*it)[2]);
    values.push_back(denominator > 0.0 ? std::stod((*it)[1]) / denominator : 0.0);
  }
  return values;
}

std::optional<double> single(const AVDictionary* exif, const char* key) {
  const std::vector<double> values = rationals(ffmpeg::value_of(exif, key));
  if (values.empty() || values[0] <= 0.0) return std::nullopt;
  return values[0];
}

std::optional<double> exif_angle_deg(const AVDictionary* exif, const std::string& key, char negative) {
  const std::vector<double> dms = rationals(ffmpeg::value_of(exif, key));
  if (dms.size() != 3) return std::nullopt;
  const double angle = dms[0] + dms[1] / 60.0 + dms[2] / 3600.0;
  const std::string reference = ffmpeg::value_of(exif, key + "Ref");
  return !reference.empty() && reference[0] == negative ? -angle : angle;
}

// "2011:10:15" and "11:22:33" of EXIF, with what follows, to ISO 8601.
std::string iso_from_exif(std::string date, const std::string& rest) {
  if (date.size() < 10) return {};
  date[4] = '-';
  date[7] = '-';
  return date.substr(0, 10) + 'T' + rest;
}

std::optional<Microseconds> exif_time(const AVDictionary* exif) {
  const std::string gps_date = ffmpeg::value_of(exif, "GPSDateStamp");
  const std::vector<double> gps_time = rationals(ffmpeg::value_of(exif, "GPSTimeStamp"));
  if (gps_date.size() >= 10 && gps_time.size() == 3) {
    const std::string clock = fmt::format("{:02.0f}:{:02.0f}:{:09.6f}Z", gps_time[0], gps_time[1], gps_time[2]);
    if (auto instant = parse_instant(iso_from_exif(gps_date, clock))) return instant;
  }
  const std::string original = ffmpeg::value_of(exif, "DateTimeOriginal");
  if (original.size() < 19) return std::nullopt;
  return parse_instant(iso_from_exif(original, original.substr(11, 8) + ffmpeg::value_of(exif, "OffsetTimeOriginal")));
}

void set_position(RecordedAt& at, double latitude_deg, double longitude_deg) {
  if (std::abs(latitude_deg) > 90.0 || std::abs(longitude_deg) > 180.0) return;
  at.latitude_deg = latitude_deg;
  at.longitude_deg = longitude_deg;
}

void read_exif_position(const AVDictionary* exif, RecordedAt& at) {
  const auto latitude = exif_angle_deg(exif, "GPSLatitude", 'S');
  const auto longitude = exif_angle_deg(exif, "GPSLongitude", 'W');
  if (!latitude || !longitude) return;
  set_position(at, *latitude, *longitude);
  const std::vector<double> height = rationals(ffmpeg::value_of(exif, "GPSAltitude"));
  if (height.size() != 1) return;
  const bool below_sea = ffmpeg::value_of(exif, "GPSAltitudeRef").find('1') != std::string::npos;
  at.height_m = below_sea ? -height[0] : height[0];
}

}  // namespace

RecordedAt recorded_at(const AVDictionary* metadata) {
  RecordedAt at;
  for (const char* key : {"com.apple.quicktime.creationdate", "creation_time"}) {
    if (!at.time) at.time = parse_instant(ffmpeg::value_of(metadata, key));
  }
  if (!at.time) at.time = exif_time(metadata);
  for (const char* key : {"com.apple.quicktime.location.ISO6709", "location", "location-eng"}) {
    if (at.latitude_deg) break;
    const auto position = parse_iso6709(ffmpeg::value_of(metadata, key));
    if (!position) continue;
    set_position(at, position->latitude_deg, position->longitude_deg);
    at.height_m = position->height_m;
  }
  if (!at.latitude_deg) read_exif_position(metadata, at);
  return at;
}

RecordedAt merge(const RecordedAt& first, const RecordedAt& second) {
  RecordedAt merged = first;
  if (!merged.time) merged.time = second.time;
  if (!merged.latitude_deg) {
    merged.latitude_deg = second.latitude_deg;
    merged.longitude_deg = second.longitude_deg;
    merged.height_m = second.height_m;
  }
  return merged;
}

ExposureInfo exposure_of(const AVDictionary* exif) {
  ExposureInfo exposure;
  exposure.exposure_s = single(exif, "ExposureTime");
  exposure.f_number = single(exif, "FNumber");
  const std::string iso = ffmpeg::value_of(exif, "ISOSpeedRatings");
  if (const double value = std::strtod(iso.c_str(), nullptr); value > 0.0) exposure.iso = value;
  return exposure;
}

std::string iso6709(double latitude_deg, double longitude_deg, std::optional<double> height_m) {
  std::string text = fmt::format("{:+010.6f}{:+011.6f}", latitude_deg, longitude_deg);
  if (height_m) text += fmt::format("{:+08.3f}", *height_m);
  return text + '/';
}

std::string iso8601(std::chrono::sys_time<std::chrono::microseconds> time) {
  using std::chrono::duration_cast;
  const auto day = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss clock(time - day);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:06}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), clock.hours().count(),
                     clock.minutes().count(), clock.seconds().count(), clock.subseconds().count());
}

}  // namespace ar
