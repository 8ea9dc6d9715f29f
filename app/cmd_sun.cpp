// skyshaft sun: where the sun stands and what of its light arrives.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>

#include "app/commands.h"
#include "app/error.h"
#include "app/output_files.h"
#include "app/sun_path_svg.h"
#include "app/sun_table.h"
#include "ar/error.h"
#include "ar/place/place.h"

namespace app {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr std::size_t kMostRows = 1'000'000;

struct SunArguments {
  std::string at;
  std::string time;
  std::string until;
  double step_s = 3600.0;
  std::string batch;
  std::string format = "text";
  std::string diagram;
  bool year = false;
  bool overwrite = false;
  SunTableOptions table;
};

render::Place place_of(const std::string& text) {
  const ar::GeoPosition position = ar::parse_position(text);
  return {position.latitude_deg * kRadPerDeg, position.longitude_deg * kRadPerDeg, position.height_m};
}

std::vector<SunRow> rows_of(const SunArguments& arguments, const render::Place& place, render::UtcTime first) {
  const render::UtcTime last = arguments.until.empty() ? first : ar::parse_time(arguments.until);
  if (last < first) throw UsageError("--until is before --time\ngive a later time");
  const auto step = std::chrono::round<std::chrono::microseconds>(std::chrono::duration<double>(arguments.step_s));
  if (static_cast<std::size_t>((last - first) / step) >= kMostRows) {
    throw UsageError(fmt::format("more than {} rows between --time and --until\ngive a longer --step", kMostRows));
  }
  std::vector<SunRow> rows;
  for (render::UtcTime time = first; time <= last; time += step) rows.push_back(sun_row(place, time, arguments.table));
  return rows;
}

void write_diagram(const SunArguments& arguments, const render::Place& place, render::UtcTime time) {
  std::ostringstream out;
  write_sun_path_svg(out, place, time, arguments.year, arguments.table.tier);
  write_whole(arguments.diagram, out.str(), arguments.overwrite);
}

int run_batch(const SunArguments& arguments) {
  std::ifstream in(arguments.batch);
  if (!in) throw ar::InputError(arguments.batch + ": cannot be opened");
  run_sun_batch(in, arguments.batch, std::cout, arguments.table);
  return 0;
}

int run(const SunArguments& arguments) try {
  if (!arguments.batch.empty()) return run_batch(arguments);
  if (arguments.at.empty() || arguments.time.empty()) throw UsageError("--at and --time are needed, or --batch");
  const render::Place place = place_of(arguments.at);
  const render::UtcTime time = ar::parse_time(arguments.time);
  if (!arguments.diagram.empty()) {
    write_diagram(arguments, place, time);
    return 0;
  }
  const std::vector<SunRow> rows = rows_of(arguments, place, time);
  if (arguments.format == "csv") write_sun_csv(std::cout, rows);
  if (arguments.format == "json") write_sun_json(std::cout, rows, arguments.table);
  if (arguments.format == "text") write_sun_text(std::cout, rows, arguments.table);
  return 0;
} catch (const std::invalid_argument& error) {
  throw UsageError(error.what());
}

void add_air_options(CLI::App& sun, SunArguments& arguments) {
  sun.add_option("--pressure", arguments.table.weather.pressure_hpa, "Air pressure in hPa, for refraction")
      ->check(CLI::Range(0.0, 1200.0))
      ->capture_default_str();
  sun.add_option("--temperature", arguments.table.weather.temperature_c, "Air temperature in degrees C")
      ->check(CLI::Range(-90.0, 60.0))
      ->capture_default_str();
  sun.add_option("--turbidity", arguments.table.turbidity, "Haziness for the illuminance: 2 clear, 10 hazy")
      ->check(CLI::Range(1.0, 30.0))
      ->capture_default_str();
}

}  // namespace

void add_sun_command(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<SunArguments>();
  CLI::App& sun = *app.add_subcommand("sun", "Where the sun stands, what of its light arrives, when it rises and sets");
  sun.add_option("--at", arguments->at, "Place: LAT,LON[,HEIGHT] in degrees (north and east positive) and metres");
  sun.add_option("--time", arguments->time, "Instant: 2024-06-21T07:30:00Z, or with an offset, +02:00");
  sun.add_option("--until", arguments->until, "Last instant of a range that starts at --time");
  sun.add_option("--step", arguments->step_s, "Step of the range: 30s, 10m, 1h, 1d")
      ->transform(CLI::AsNumberWithUnit(std::map<std::string, double>{{"s", 1}, {"m", 60}, {"h", 3600}, {"d", 86400}}))
      ->check(CLI::PositiveNumber)
      ->default_str("1h");
  sun.add_option("--tier", arguments->table.tier, "precise (ERFA), psa (0.012 deg, faster) or daily (1.4 deg)")
      ->transform(CLI::CheckedTransformer(std::map<std::string, render::SunTier>{
          {"daily", render::SunTier::Daily}, {"psa", render::SunTier::Psa}, {"precise", render::SunTier::Precise}}))
      ->default_str("precise");
  sun.add_option("--format", arguments->format, "text, csv or json")
      ->check(CLI::IsMember({"text", "csv", "json"}))
      ->capture_default_str();
  sun.add_option("--batch", arguments->batch,
                 "CSV with columns utc,lat_deg,lon_deg,height_m; prints them with the sun");
  sun.add_option("--diagram", arguments->diagram, "Write the day's sun path to this SVG file instead");
  sun.add_flag("--year", arguments->year, "With --diagram: the whole year's paths");
  sun.add_flag("--overwrite", arguments->overwrite, "With --diagram: replace an existing file");
  add_air_options(sun, *arguments);
  sun.footer(
      "Azimuth is from true north, clockwise; elevation is geometric, `apparent` is lifted by refraction.\n\n"
      "Example:\n  skyshaft sun --at 48.8584,2.2945,35 --time 2024-06-21T07:30:00Z");
  sun.callback([&program, arguments] { program.action = [arguments] { return run(*arguments); }; });
}

}  // namespace app
