#include "app/report/sun_path_svg.h"

#include <fmt/ostream.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "ar/place/place.h"
#include "render/base/angles.h"

namespace app {
namespace {

using namespace std::chrono;

constexpr double kSize = 800.0;
constexpr double kCentre = kSize / 2.0;
constexpr double kRadius = 340.0;

struct Point {
  double x = 0.0;
  double y = 0.0;
};

Point on_page(double azimuth_rad, double elevation_rad) {
  const double radius = kRadius * (1.0 - elevation_rad / (std::numbers::pi / 2.0));
  return {kCentre + radius * std::sin(azimuth_rad), kCentre - radius * std::cos(azimuth_rad)};
}

// Where the sun stands on the page; nothing while it is down.
std::optional<Point> sun_on_page(const render::Place& place, render::UtcTime time, render::SunTier tier) {
  const render::SunPosition sun = render::sun_position(place, time, tier);
  if (sun.apparent_elevation_rad < 0.0) return std::nullopt;
  return on_page(sun.azimuth_rad, sun.apparent_elevation_rad);
}

// Draws `count` instants from `start` as lines, broken where the sun is down.
void write_path(std::ostream& out, const render::Place& place, render::SunTier tier, render::UtcTime start,
                microseconds step, int count, const std::string& style) {
  bool drawing = false;
  std::string path;
  for (int i = 0; i <= count; ++i) {
    const auto point = sun_on_page(place, start + step * i, tier);
    if (point) path += fmt::format("{}{:.1f} {:.1f} ", drawing ? "L" : "M", point->x, point->y);
    drawing = point.has_value();
  }
  if (!path.empty()) fmt::print(out, "<path d=\"{}\" {}/>\n", path, style);
}

void write_label(std::ostream& out, Point at, const std::string& text, const std::string& anchor = "middle") {
  fmt::print(out, "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", at.x, at.y, anchor, text);
}

void write_grid(std::ostream& out) {
  for (int elevation = 0; elevation < 90; elevation += 10) {
    const double radius = kRadius * (1.0 - elevation / 90.0);
    fmt::print(out, "<circle cx=\"{0}\" cy=\"{0}\" r=\"{1:.1f}\" fill=\"none\" stroke=\"#ccc\"/>\n", kCentre, radius);
    if (elevation % 30 == 0)
      write_label(out, {kCentre + 4.0, kCentre - radius + 12.0}, fmt::format("{}&#176;", elevation), "start");
  }
  const std::vector<std::string> names{"N", "30", "60", "E", "120", "150", "S", "210", "240", "W", "300", "330"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double azimuth = static_cast<double>(i) * std::numbers::pi / 6.0;
    const Point rim = on_page(azimuth, 0.0);
    fmt::print(out, "<path d=\"M{0} {0} L{1:.1f} {2:.1f}\" stroke=\"#ddd\"/>\n", kCentre, rim.x, rim.y);
    const Point outside = on_page(azimuth, -0.08);
    write_label(out, {outside.x, outside.y + 4.0}, names[i]);
  }
}

void write_hours(std::ostream& out, const render::Place& place, render::SunTier tier, sys_days day) {
  for (int hour = 0; hour < 24; ++hour) {
    const auto point = sun_on_page(place, day + hours(hour), tier);
    if (!point) continue;
    fmt::print(out, "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"#d60\"/>\n", point->x, point->y);
    write_label(out, {point->x, point->y - 8.0}, fmt::format("{:02}", hour));
  }
}

void write_year(std::ostream& out, const render::Place& place, render::SunTier tier, year of) {
  for (unsigned m = 1; m <= 12; ++m) {
    const sys_days day{of / month(m) / 21};
    write_path(out, place, tier, day, minutes(5), 288, "fill=\"none\" stroke=\"#d60\" stroke-width=\"1.5\"");
  }
  const sys_days new_year{of / January / 1};
  for (int hour = 0; hour < 24; ++hour) {
    write_path(out, place, tier, new_year + hours(hour), days(3), 122, "fill=\"none\" stroke=\"#369\"");
    const auto label = sun_on_page(place, sys_days{of / June / 21} + hours(hour), tier);
    if (label) write_label(out, {label->x, label->y - 4.0}, fmt::format("{:02}", hour));
  }
}

}  // namespace

void write_sun_path_svg(std::ostream& out, const render::Place& place, render::UtcTime time, bool whole_year,
                        render::SunTier tier) {
  const sys_days day = floor<days>(time);
  const year_month_day date{day};
  fmt::print(out,
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\" "
             "font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
             kSize, kSize + 30.0);
  write_grid(out);
  const std::string when =
      whole_year ? std::to_string(static_cast<int>(date.year())) : ar::format_time(day).substr(0, 10);
  write_label(out, {kCentre, kSize + 15.0},
              fmt::format("The sun over {:.4f} N, {:.4f} E, {}; hours in UTC", place.latitude_rad * render::kDegPerRad,
                          place.longitude_rad * render::kDegPerRad, when));
  if (whole_year) {
    write_year(out, place, tier, date.year());
  } else {
    write_path(out, place, tier, day, minutes(5), 288, "fill=\"none\" stroke=\"#d60\" stroke-width=\"2\"");
    write_hours(out, place, tier, day);
  }
  out << "</svg>\n";
}

}  // namespace app
