#include "app/tables/sun_table.h"

#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "app/tables/csv.h"
#include "ar/error.h"
#include "ar/place/place.h"
#include "render/base/angles.h"
#include "render/sun/spectrum.h"
#include "render/sun/sun_events.h"

namespace app {
namespace {

void write_csv_header(std::ostream& out) {
  out << "utc,lat_deg,lon_deg,height_m,azimuth_deg,elevation_deg,apparent_elevation_deg,illuminance_lux,r,g,b\n";
}

// `utc` as it was given, so that a batch's rows can be joined again.
void write_csv_row(std::ostream& out, const std::string& utc, const SunRow& row) {
  const glm::dvec3& rgb = row.light.illuminance_rgb;
  fmt::print(out, "{},{:.9g},{:.9g},{:.9g},{:.6f},{:.6f},{:.6f},{:.6g},{:.6g},{:.6g},{:.6g}\n", utc,
             row.place.latitude_rad * render::kDegPerRad, row.place.longitude_rad * render::kDegPerRad,
             row.place.height_m, row.position.azimuth_rad * render::kDegPerRad,
             row.position.elevation_rad * render::kDegPerRad, row.position.apparent_elevation_rad * render::kDegPerRad,
             render::luminance(rgb), rgb.r, rgb.g, rgb.b);
}

nlohmann::json json_time(const std::optional<render::UtcTime>& time) {
  return time ? nlohmann::json(ar::format_time(*time)) : nlohmann::json(nullptr);
}

nlohmann::json json_row(const SunRow& row, const SunTableOptions& options) {
  const glm::dvec3& rgb = row.light.illuminance_rgb;
  const render::SunEvents events = render::sun_events(row.place, row.time, render::kSunriseElevationRad, options.tier);
  return {{"utc", ar::format_time(row.time)},
          {"lat_deg", row.place.latitude_rad * render::kDegPerRad},
          {"lon_deg", row.place.longitude_rad * render::kDegPerRad},
          {"height_m", row.place.height_m},
          {"azimuth_deg", row.position.azimuth_rad * render::kDegPerRad},
          {"elevation_deg", row.position.elevation_rad * render::kDegPerRad},
          {"apparent_elevation_deg", row.position.apparent_elevation_rad * render::kDegPerRad},
          {"distance_au", row.position.distance_au},
          {"angular_radius_deg", row.position.angular_radius_rad * render::kDegPerRad},
          {"shadow_radius_deg", row.light.shadow_radius_rad * render::kDegPerRad},
          {"equation_of_time_s", render::equation_of_time_s(row.time, options.tier)},
          {"visible_disc_fraction", row.light.visible_disc_fraction},
          {"illuminance_lux", render::luminance(rgb)},
          {"illuminance_rgb", {rgb.r, rgb.g, rgb.b}},
          {"sunrise", json_time(events.rise)},
          {"transit", ar::format_time(events.transit)},
          {"sunset", json_time(events.set)}};
}

std::string whole_seconds(render::UtcTime time) {
  return ar::format_time(std::chrono::round<std::chrono::seconds>(time));
}

void write_events(std::ostream& out, const SunRow& row, const SunTableOptions& options) {
  const render::SunEvents day = render::sun_events(row.place, row.time, render::kSunriseElevationRad, options.tier);
  const std::string none = day.always_up ? "none that day: the sun stays up" : "none that day";
  const auto text = [&](const std::optional<render::UtcTime>& time) { return time ? whole_seconds(*time) : none; };
  fmt::print(out, "sunrise             {}\ntransit             {}  at {:.3f} deg\nsunset              {}\n",
             text(day.rise), whole_seconds(day.transit), day.transit_elevation_rad * render::kDegPerRad, text(day.set));
}

void write_instant(std::ostream& out, const SunRow& row, const SunTableOptions& options) {
  const glm::dvec3& rgb = row.light.illuminance_rgb;
  fmt::print(
      out,
      "time                {}\nplace               {:.6f} N  {:.6f} E  {:.0f} m\n"
      "azimuth             {:.4f} deg from north, clockwise\nelevation           {:.4f} deg\n"
      "apparent elevation  {:.4f} deg with refraction\ndistance            {:.6f} au\n"
      "angular radius      {:.4f} deg; {:.4f} for soft shadows, for its limb is dark\nequation of time    {:+.1f} s\n"
      "illuminance         {:.0f} lux facing the sun, {:.0f} % of the disc up\n"
      "illuminance rgb     {:.0f} {:.0f} {:.0f} lux, linear Rec. 709\n",
      ar::format_time(row.time), row.place.latitude_rad * render::kDegPerRad,
      row.place.longitude_rad * render::kDegPerRad, row.place.height_m, row.position.azimuth_rad * render::kDegPerRad,
      row.position.elevation_rad * render::kDegPerRad, row.position.apparent_elevation_rad * render::kDegPerRad,
      row.position.distance_au, row.position.angular_radius_rad * render::kDegPerRad,
      row.light.shadow_radius_rad * render::kDegPerRad, render::equation_of_time_s(row.time, options.tier),
      render::luminance(rgb), 100.0 * row.light.visible_disc_fraction, rgb.r, rgb.g, rgb.b);
  write_events(out, row, options);
}

void check_latitude(const CsvReader& csv, double latitude_deg) {
  if (std::abs(latitude_deg) <= 90.0) return;
  throw ar::InputError(fmt::format("{}: lat_deg is {}\nexpected -90 to 90", csv.where(), latitude_deg));
}

}  // namespace

SunRow sun_row(const render::Place& place, render::UtcTime time, const SunTableOptions& options) {
  SunRow row{time, place, render::sun_position(place, time, options.tier, options.weather), {}};
  row.light = render::sun_light(row.position, options.turbidity, place.height_m);
  return row;
}

void write_sun_csv(std::ostream& out, const std::vector<SunRow>& rows) {
  write_csv_header(out);
  for (const SunRow& row : rows) write_csv_row(out, ar::format_time(row.time), row);
}

void write_sun_json(std::ostream& out, const std::vector<SunRow>& rows, const SunTableOptions& options) {
  nlohmann::json array = nlohmann::json::array();
  for (const SunRow& row : rows) array.push_back(json_row(row, options));
  out << array.dump(2) << '\n';
}

void write_sun_text(std::ostream& out, const std::vector<SunRow>& rows, const SunTableOptions& options) {
  if (rows.size() == 1) return write_instant(out, rows.front(), options);
  fmt::print(out, "{:<24} {:>11} {:>11} {:>11} {:>11}\n", "time", "azimuth", "elevation", "apparent", "lux");
  for (const SunRow& row : rows) {
    fmt::print(out, "{:<24} {:>11.4f} {:>11.4f} {:>11.4f} {:>11.0f}\n", ar::format_time(row.time),
               row.position.azimuth_rad * render::kDegPerRad, row.position.elevation_rad * render::kDegPerRad,
               row.position.apparent_elevation_rad * render::kDegPerRad, render::luminance(row.light.illuminance_rgb));
  }
}

void run_sun_batch(std::istream& in, const std::string& name, std::ostream& out, const SunTableOptions& options) {
  CsvReader csv(in, name, {"utc", "lat_deg", "lon_deg", "height_m"});
  write_csv_header(out);
  while (csv.next()) {
    const double latitude_deg = csv.number("lat_deg");
    check_latitude(csv, latitude_deg);
    const render::Place place{latitude_deg / render::kDegPerRad, csv.number("lon_deg") / render::kDegPerRad,
                              csv.number("height_m")};
    render::UtcTime time;
    try {
      time = ar::parse_time(csv.text("utc"));
    } catch (const std::invalid_argument& error) {
      throw ar::InputError(fmt::format("{}: utc: {}", csv.where(), error.what()));
    }
    write_csv_row(out, csv.text("utc"), sun_row(place, time, options));
  }
}

}  // namespace app
