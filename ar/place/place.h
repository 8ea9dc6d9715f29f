#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace ar {

using UtcTime = std::chrono::sys_time<std::chrono::microseconds>;

struct GeoPosition {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double height_m = 0.0;
};

// "48.8584,2.2945" or "48.8584,2.2945,35". Throws std::invalid_argument that says what was found and accepted.
GeoPosition parse_position(const std::string& text);
// ISO 6709, as phones write it: "+48.8584+002.2945+035.0/".
std::optional<GeoPosition> parse_iso6709(const std::string& text);
// ISO 8601 with seconds optional and 'Z' or an offset required: "2024-06-21T07:30:00Z", "2024-06-21 09:30+02:00",
// fractions of a second, 23:59:60. Throws std::invalid_argument.
UtcTime parse_time(const std::string& text);
std::string format_time(UtcTime time);  // "2024-06-21T07:30:00Z", fraction only where there is one

}  // namespace ar
