#pragma once

#include "ar/capture/ffmpeg.h"
#include "ar/capture/source.h"

namespace ar {

// Where and when, out of a container's or a stream's metadata (com.apple.quicktime.creationdate, creation_time;
// com.apple.quicktime.location.ISO6709, location, location-eng) or a still's EXIF (GPS position, GPS time, or
// DateTimeOriginal with its OffsetTimeOriginal). What is absent, out of range or has no time zone stays unset.
RecordedAt recorded_at(const AVDictionary* metadata);

// Fills what `first` lacks from `second`.
RecordedAt merge(const RecordedAt& first, const RecordedAt& second);

// Exposure out of a still's EXIF.
ExposureInfo exposure_of(const AVDictionary* exif);

// "+48.858400+002.294500+035.000/" and "2024-06-21T07:30:00.000000Z", as containers take them.
std::string iso6709(double latitude_deg, double longitude_deg, std::optional<double> height_m);
std::string iso8601(std::chrono::sys_time<std::chrono::microseconds> time);

}  // namespace ar
