#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "ar/place/place.h"
#include "render/base/number.h"

namespace ar {
namespace {

using render::parse_number;
using render::parse_unsigned;
using render::trimmed;

[[noreturn]] void refuse_position(const std::string& text, const std::string& why) {
  throw std::invalid_argument(
      fmt::format("position '{}': {}\naccepted: LATITUDE,LONGITUDE[,HEIGHT] in degrees (north and east positive) and "
                  "metres, such as 48.8584,2.2945,35",
                  text, why));
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

bool on_earth(const GeoPosition& p) {
  return std::abs(p.latitude_deg) <= 90.0 && std::abs(p.longitude_deg) <= 180.0;
}

// One signed number of ISO 6709: up to the next sign or the solidus. `digits` is how many stand before the point.
struct SignedField {
  double value = 0.0;
  std::size_t digits = 0;
};

std::optional<SignedField> take_signed(std::string_view& text) {
  if (text.empty() || (text[0] != '+' && text[0] != '-')) return std::nullopt;
  const std::size_t end = std::min(text.find_first_of("+-/C", 1), text.size());
  const std::string_view number = text.substr(1, end - 1);
  const std::optional<double> value = parse_unsigned(number);
  if (!value) return std::nullopt;
  const SignedField field{text[0] == '-' ? -*value : *value, std::min(number.find('.'), number.size())};
  text.remove_prefix(end);
  return field;
}

// DD.D, DDMM.M or DDMMSS.S (one digit of degrees more for a longitude).
std::optional<double> degrees_of(const SignedField& field, std::size_t degree_digits) {
  const double magnitude = std::abs(field.value);
  double degrees = 0.0;
  if (field.digits == degree_digits) {
    degrees = magnitude;
  } else if (field.digits == degree_digits + 2) {
    const double whole = std::floor(magnitude / 100.0);
    const double minutes = magnitude - 100.0 * whole;
    if (minutes >= 60.0) return std::nullopt;
    degrees = whole + minutes / 60.0;
  } else if (field.digits == degree_digits + 4) {
    const double whole = std::floor(magnitude / 1e4);
    const double minutes = std::floor(magnitude / 100.0) - 100.0 * whole;
    const double seconds = magnitude - 1e4 * whole - 100.0 * minutes;
    if (minutes >= 60.0 || seconds >= 60.0) return std::nullopt;
    degrees = whole + minutes / 60.0 + seconds / 3600.0;
  } else {
    return std::nullopt;
  }
  return std::copysign(degrees, field.value);
}

}  // namespace

GeoPosition parse_position(const std::string& text) {
  const std::vector<std::string_view> parts = split(text, ',');
  if (parts.size() != 2 && parts.size() != 3)
    refuse_position(text, fmt::format("{} numbers where 2 or 3 belong", parts.size()));
  std::vector<double> values;
  for (std::string_view part : parts) {
    const std::optional<double> value = parse_number(trimmed(part));
    if (!value) refuse_position(text, fmt::format("'{}' is no number", part));
    values.push_back(*value);
  }
  const GeoPosition position{values[0], values[1], values.size() == 3 ? values[2] : 0.0};
  if (std::abs(position.latitude_deg) > 90.0) {
    refuse_position(text, fmt::format("latitude {} is not within -90 ... 90", position.latitude_deg));
  }
  if (std::abs(position.longitude_deg) > 180.0) {
    refuse_position(text, fmt::format("longitude {} is not within -180 ... 180", position.longitude_deg));
  }
  return position;
}

// A coordinate reference system may follow ("CRSWGS_84/"): phones write none or WGS 84, so it is not looked at.
std::optional<GeoPosition> parse_iso6709(const std::string& text) {
  std::string_view rest = trimmed(text);
  const auto latitude = take_signed(rest);
  const auto longitude = latitude ? take_signed(rest) : std::nullopt;
  if (!longitude) return std::nullopt;
  const auto latitude_deg = degrees_of(*latitude, 2);
  const auto longitude_deg = degrees_of(*longitude, 3);
  if (!latitude_deg || !longitude_deg) return std::nullopt;
  GeoPosition position{*latitude_deg, *longitude_deg, 0.0};
  if (!rest.empty() && (rest[0] == '+' || rest[0] == '-')) {
    const auto height = take_signed(rest);
    if (!height) return std::nullopt;
    position.height_m = height->value;
  }
  const bool ended = rest.empty() || rest[0] == '/' || rest.starts_with("CRS");
  return ended && on_earth(position) ? std::optional(position) : std::nullopt;
}

}  // namespace ar
