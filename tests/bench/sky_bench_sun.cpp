#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "render/sun/limb_darkening.h"
#include "tests/bench/sky_bench.h"
#include "tests/bench/svg_plot.h"

namespace bench {
namespace {

using render::SunTier;

constexpr int kSamples = 30000;
constexpr int kFirstYear = 1950;
constexpr int kYears = 151;

// Instants evenly over 1950 to 2100 at places that share no period with days or years.
struct Sample {
  double year;
  render::Place place;
  render::UtcTime time;
};

Sample sample(int i) {
  using namespace std::chrono;
  const render::UtcTime first = sys_days{std::chrono::year{kFirstYear} / January / 1};
  const auto span = sys_days{std::chrono::year{kFirstYear + kYears} / January / 1} - first;
  const render::UtcTime time = first + duration_cast<microseconds>(span) / kSamples * i + seconds(i * 37 % 86400);
  return {kFirstYear + static_cast<double>(kYears) * i / kSamples,
          {(std::fmod(i * 61.803, 180.0) - 90.0) * kDeg, (std::fmod(i * 137.508, 360.0) - 180.0) * kDeg, 0.0},
          time};
}

double nanoseconds_of(SunTier tier) {
  constexpr int kCalls = 20000;
  double sum = 0.0;
  const std::clock_t start = std::clock();
  for (int i = 0; i < kCalls; ++i) {
    const Sample at = sample(i);
    sum += render::sun_position(at.place, at.time, tier).elevation_rad;
  }
  return std::isfinite(sum) ? cpu_seconds_since(start) / kCalls * 1e9 : 0.0;
}

}  // namespace

void measure_sun(Report& report) {
  std::string table = "| `--tier` | largest error, degrees | RMS, degrees | ns a call |\n|---|---|---|---|\n";
  std::vector<Series> plot;
  std::vector<glm::dvec3> truth;
  for (int i = 0; i < kSamples; ++i) {
    const Sample at = sample(i);
    truth.push_back(render::sun_position(at.place, at.time).direction_in_world());
  }
  for (const auto& [name, tier] : {std::pair<const char*, SunTier>{"daily", SunTier::Daily}, {"psa", SunTier::Psa}}) {
    double worst = 0.0;
    double squared = 0.0;
    Series series{name, std::vector<std::pair<double, double>>(kYears), true};
    for (int i = 0; i < kSamples; ++i) {
      const Sample at = sample(i);
      const glm::dvec3 direction = render::sun_position(at.place, at.time, tier).direction_in_world();
      const double error = 2.0 * std::asin(0.5 * glm::length(direction - truth[static_cast<std::size_t>(i)])) / kDeg;
      worst = std::max(worst, error);
      squared += error * error;
      const int year = static_cast<int>(at.year) - kFirstYear;
      auto& point = series.points[static_cast<std::size_t>(year)];
      point = {kFirstYear + year + 0.5, std::max(point.second, error)};
    }
    table += fmt::format("| {} | {:.4f} | {:.4f} | {:.0f} |\n", name, worst, std::sqrt(squared / kSamples),
                         nanoseconds_of(tier));
    plot.push_back(std::move(series));
  }
  table += fmt::format("| precise | 0 | 0 | {:.0f} |\n", nanoseconds_of(SunTier::Precise));
  report.tables["sun"] = table;
  report.plots["sun_error.svg"] =
      svg_plot("Largest error of the year against `precise`", {"year"}, {"degrees", true}, plot);

  std::vector<Series> limb;
  for (const double nm : {450.0, 550.0, 650.0}) {
    Series series{fmt::format("{:g} nm", nm), {}, true};
    for (int i = 0; i <= 100; ++i) series.points.emplace_back(0.01 * i, render::limb_darkening(0.01 * i, nm));
    limb.push_back(std::move(series));
  }
  report.plots["sun_limb.svg"] =
      svg_plot("The sun's disc over its mean", {"distance from its middle, radii"}, {"radiance"}, limb);
}

}  // namespace bench
