#include <fmt/ostream.h>

#include <cmath>
#include <map>
#include <numbers>

#include "app/tables/csv.h"
#include "app/tables/sky_table.h"
#include "ar/error.h"
#include "ar/place/place.h"
#include "render/base/angles.h"

namespace app {
namespace {

const std::vector<std::string> kRequired = {"utc", "lat_deg", "lon_deg", "view_azimuth_deg", "view_elevation_deg"};
const std::vector<std::string> kOptional = {"turbidity", "dni_wm2",           "dhi_wm2",        "epsilon",
                                            "delta",     "sun_elevation_deg", "sun_azimuth_deg"};

double within(const CsvReader& csv, const std::string& column, double value, double low, double high) {
  if (value >= low && value <= high) return value;
  throw ar::InputError(fmt::format("{}: {} is {}\nexpected {} to {}", csv.where(), column, value, low, high));
}

render::UtcTime time_of(const CsvReader& csv) {
  try {
    return ar::parse_time(csv.text("utc"));
  } catch (const std::invalid_argument& error) {
    throw ar::InputError(fmt::format("{}: utc: {}", csv.where(), error.what()));
  }
}

// Place and time may be left empty where the sun is given.
SunRequest sun_of(const CsvReader& csv) {
  SunRequest request;
  const std::optional<double> elevation_deg = csv.optional_number("sun_elevation_deg");
  if (elevation_deg) {
    request.elevation_rad = within(csv, "sun_elevation_deg", *elevation_deg, -90, 90) * render::kRadPerDeg;
  }
  const std::optional<double> azimuth_deg = csv.optional_number("sun_azimuth_deg");
  if (azimuth_deg) request.azimuth_rad = *azimuth_deg * render::kRadPerDeg;
  if (elevation_deg && csv.text("utc").empty()) return request;
  const double latitude_deg = within(csv, "lat_deg", csv.number("lat_deg"), -90.0, 90.0);
  request.place = render::Place{latitude_deg * render::kRadPerDeg, csv.number("lon_deg") * render::kRadPerDeg, 0.0};
  request.time = time_of(csv);
  return request;
}

render::SkyOptions options_of(const CsvReader& csv, render::SkyOptions options) {
  if (const auto turbidity = csv.optional_number("turbidity")) {
    options.turbidity = within(csv, "turbidity", *turbidity, 1.0, 64.0);
  }
  const auto dni = csv.optional_number("dni_wm2");
  const auto dhi = csv.optional_number("dhi_wm2");
  if (dni && dhi) options.irradiance = render::SkyIrradiance{*dni, *dhi};
  const auto epsilon = csv.optional_number("epsilon");
  const auto delta = csv.optional_number("delta");
  if (epsilon && delta) options.condition = render::SkyCondition{*epsilon, *delta};
  return options;
}

std::string key_of(const CsvReader& csv) {
  std::string key = csv.text("utc") + ',' + csv.text("lat_deg") + ',' + csv.text("lon_deg");
  for (const std::string& column : kOptional) key += csv.has(column) ? ',' + csv.text(column) : ",";
  return key;
}

}  // namespace

void run_sky_batch(std::istream& in, const std::string& name, std::ostream& out, const render::SkyOptions& options) {
  CsvReader csv(in, name, kRequired);
  std::vector<std::string> columns = kRequired;
  for (const std::string& column : kOptional) {
    if (csv.has(column)) columns.push_back(column);
  }
  for (const std::string& column : columns) out << column << ',';
  out << "X,Y,Z,sun_angle_deg\n";

  constexpr std::size_t kSkiesKept = 256;  // directions of one sky come in runs, or interleaved with a few others
  std::map<std::string, render::Daylight> skies;
  while (csv.next()) {
    const std::string key = key_of(csv);
    if (skies.size() >= kSkiesKept) skies.clear();
    auto found = skies.find(key);
    if (found == skies.end()) found = skies.emplace(key, answer(sun_of(csv), options_of(csv, options))).first;
    const double elevation_deg = within(csv, "view_elevation_deg", csv.number("view_elevation_deg"), -90.0, 90.0);
    const glm::dvec3 view =
        view_direction({csv.number("view_azimuth_deg") * render::kRadPerDeg, elevation_deg * render::kRadPerDeg});
    const glm::dvec3 xyz = found->second.sky->luminance_xyz(view);
    for (const std::string& column : columns) out << csv.text(column) << ',';
    fmt::print(out, "{:.8g},{:.8g},{:.8g},{:.6f}\n", xyz.x, xyz.y, xyz.z,
               sun_angle_rad(found->second, view) / render::kRadPerDeg);
  }
}

}  // namespace app
