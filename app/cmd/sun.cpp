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

#include "app/cmd/commands.h"
#include "app/error.h"
#include "app/options/sky.h"
#include "app/process/output_files.h"
#include "app/report/sun_path_svg.h"
#include "app/tables/sky_request.h"
#include "app/tables/sun_average_table.h"
#include "app/tables/sun_table.h"
#include "ar/error.h"
#include "ar/place/place.h"
#include "render/base/angles.h"

namespace app {
namespace {

constexpr std::size_t kMostRows = 1'000'000;
constexpr std::size_t kMostSkies = 100'000;  // an hour or so of computing

struct SunArguments {
  PlaceTimeArguments where;
  std::string until;
  double step_s = 3600.0;
  std::string batch;
  std::string format = "text";
  std::string diagram;
  bool year = false;
  bool overwrite = false;
  bool average = false;
  std::vector<double> plane_deg;
  double bin_deg = 15.0;
  SkyModelArguments model;
  SunTableOptions table;
};

std::chrono::microseconds step_of(const SunArguments& arguments) {
  return std::chrono::round<std::chrono::microseconds>(std::chrono::duration<double>(arguments.step_s));
}

// The last instant of the range; checks that the range is one.
render::UtcTime last_of(const SunArguments& arguments, render::UtcTime first, std::size_t most) {
  const render::UtcTime last = arguments.until.empty() ? first : ar::parse_time(arguments.until);
  if (last < first) throw UsageError("--until is before --time\ngive a later time");
  const auto step = step_of(arguments);
  if (step.count() <= 0) throw UsageError("--step is shorter than a microsecond\ngive a longer one");
  if (static_cast<std::size_t>((last - first) / step) >= most) {
    throw UsageError(fmt::format("more than {} rows between --time and --until\ngive a longer --step", most));
  }
  return last;
}

std::vector<SunRow> rows_of(const SunArguments& arguments, const render::Place& place, render::UtcTime first) {
  const render::UtcTime last = last_of(arguments, first, kMostRows);
  const auto step = step_of(arguments);
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

render::LitPlane plane_of(const SunArguments& arguments) {
  if (arguments.plane_deg.empty()) return {};
  if (!(arguments.plane_deg[1] >= 0.0 && arguments.plane_deg[1] <= 180.0)) {
    throw UsageError(fmt::format("--plane leans {} degrees\nexpected AZIMUTH,TILT with a tilt of 0 (level) to 180",
                                 arguments.plane_deg[1]));
  }
  return {arguments.plane_deg[0] * render::kRadPerDeg, arguments.plane_deg[1] * render::kRadPerDeg};
}

int run_average(const SunArguments& arguments, const render::Place& place, render::UtcTime first) {
  const double rows = 90.0 / arguments.bin_deg;
  if (std::abs(rows - std::round(rows)) > 1e-9) {
    throw UsageError(fmt::format("--resolution of {} degrees does not divide 90", arguments.bin_deg));
  }
  const render::AverageLight light = render::average_light({.place = place,
                                                            .first = first,
                                                            .last = last_of(arguments, first, kMostSkies),
                                                            .step = step_of(arguments),
                                                            .tier = arguments.table.tier,
                                                            .weather = arguments.table.weather,
                                                            .sky = options_of(arguments.model),
                                                            .plane = plane_of(arguments),
                                                            .bin_deg = arguments.bin_deg});
  warn_once(light.beyond_range);
  if (arguments.format == "csv") write_average_csv(std::cout, light);
  if (arguments.format == "json") write_average_json(std::cout, light);
  if (arguments.format == "text") write_average_text(std::cout, light);
  return 0;
}

int run(SunArguments& arguments) try {
  arguments.table.turbidity = arguments.model.sky.turbidity;
  if (!arguments.batch.empty()) return run_batch(arguments);
  if (arguments.where.at.empty() || arguments.where.time.empty()) {
    throw UsageError("--at and --time are needed, or --batch");
  }
  const render::Place place = place_of(arguments.where.at);
  const render::UtcTime time = ar::parse_time(arguments.where.time);
  if (arguments.average) return run_average(arguments, place, time);
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
  add_turbidity_option(sun, arguments.model.sky.turbidity);
}

void add_average_options(CLI::App& sun, SunArguments& arguments) {
  sun.add_flag("--average", arguments.average,
               "Mean light of sun and sky on a plane over the range, by the direction that it comes from");
  sun.add_option("--plane", arguments.plane_deg,
                 "With --average: the plane faces AZIMUTH and leans TILT degrees from level")
      ->delimiter(',')
      ->expected(2)
      ->default_str("0,0");
  sun.add_option("--resolution", arguments.bin_deg,
                 "With --average: size of a direction bin in degrees, a divisor of 90")
      ->check(CLI::Range(1.0, 90.0))
      ->capture_default_str();
  add_model_options(sun, arguments.model);
}

}  // namespace

void add_sun_command(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<SunArguments>();
  CLI::App& sun = *app.add_subcommand("sun", "Where the sun stands, what of its light arrives, when it rises and sets");
  add_place_time_options(sun, arguments->where);
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
  add_average_options(sun, *arguments);
  sun.footer(
      "Azimuth is from true north, clockwise; elevation is geometric, `apparent` is lifted by refraction.\n\n"
      "Examples:\n  skyshaft sun --at 48.8584,2.2945,35 --time 2024-06-21T07:30:00Z\n"
      "  skyshaft sun --at 48.8584,2.2945,35 --time 2024-06-21T03:00:00Z --until 2024-06-21T21:00:00Z --step 15m \\\n"
      "    --average --plane 180,30");
  sun.callback([&program, arguments] { program.action = [arguments] { return run(*arguments); }; });
}

}  // namespace app
