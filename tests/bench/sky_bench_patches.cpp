#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/sky/patches.h"
#include "render/sky/sky_model.h"
#include "render/sun/spectrum.h"
#include "tests/bench/sky_bench.h"
#include "tests/bench/svg_plot.h"

namespace bench {
namespace {

using render::luminance;
using render::SkyModel;

constexpr double kPi = std::numbers::pi;

// The slit is 1 degree wide, from horizon to horizon through the zenith.
double seen_through_slit(const glm::dvec3& direction) {
  return std::abs(direction.x) < std::sin(0.5 * kDeg) ? 1.0 : 0.0;
}

double angle_to_slit_edge(const glm::dvec3& direction) {
  return std::abs(std::asin(std::min(std::abs(direction.x), 1.0)) - 0.5 * kDeg);
}

// Even in projected solid angle.
double open_lux(const SkyModel& sky) {
  constexpr int kRows = 1400;
  constexpr int kSectors = 1440;
  double sum = 0.0;
  for (int row = 0; row < kRows; ++row) {
    const double sine2 = (row + 0.5) / kRows;
    for (int sector = 0; sector < kSectors; ++sector) {
      const double azimuth = 2.0 * kPi * (sector + 0.5) / kSectors;
      sum += luminance(sky.luminance_rgb(
          {std::sqrt(sine2) * std::sin(azimuth), std::sqrt(sine2) * std::cos(azimuth), std::sqrt(1.0 - sine2)}));
    }
  }
  return sum * kPi / (kRows * kSectors);
}

// Along the slit and across it, so that no sample lies half outside.
double slit_lux(const SkyModel& sky) {
  constexpr int kAlong = 8000;
  constexpr int kAcross = 20;
  double sum = 0.0;
  for (int i = 0; i < kAlong; ++i) {
    const double along = kPi * (i + 0.5) / kAlong;
    for (int j = 0; j < kAcross; ++j) {
      const double across = kDeg * ((j + 0.5) / kAcross - 0.5);
      const glm::dvec3 view(std::sin(across), std::cos(across) * std::cos(along), std::cos(across) * std::sin(along));
      sum += luminance(sky.luminance_rgb(view)) * std::cos(across) * view.z;
    }
  }
  return sum * kPi / kAlong * kDeg / kAcross;
}

struct Found {
  double patches;
  double error_percent;
  double ms;
};

Found found(const SkyModel& sky, const render::PatchOptions& options, double truth) {
  const std::clock_t start = std::clock();
  const render::SkyPatches patches = render::make_patches(sky, options);
  const double ms = cpu_seconds_since(start) * 1e3;
  return {static_cast<double>(patches.patches().size()),
          100.0 * (luminance(patches.illuminance_rgb({0, 0, 1})) / truth - 1.0), ms};
}

}  // namespace

void measure_patches(Report& report) {
  const auto sky = render::make_sky({}, sun_at(35.0));
  const double open = open_lux(*sky);
  const double slit = slit_lux(*sky);
  std::string table =
      "| tessellation | patches, open sky | error of horizontal illuminance | ms | patches, 1 degree slit | error of "
      "light through it | ms |\n|---|---|---|---|---|---|---|\n";
  std::vector<Series> plot{
      {"open: domes", {}, true}, {"open: geodesic", {}, true}, {"slit: domes", {}, true}, {"slit: geodesic", {}, true}};
  for (const auto& [name, max_error] : {std::pair<const char*, double>{"dome144", 0.0},
                                        {"dome5728", 0.0},
                                        {"geodesic", 0.05},
                                        {"geodesic", 0.02},
                                        {"geodesic", 0.01},
                                        {"geodesic", 0.005},
                                        {"geodesic", 0.002},
                                        {"geodesic", 0.001}}) {
    const bool adaptive = max_error > 0.0;
    render::PatchOptions options;
    options.tessellation = name;
    if (adaptive) options.max_error = max_error;
    const Found tiles = found(*sky, options, open);
    options.visibility = {seen_through_slit, angle_to_slit_edge};
    const Found strip = found(*sky, options, slit);
    table += fmt::format("| {}{} | {:.0f} | {:+.3f} % | {:.1f} | {:.0f} | {:+.2f} % | {:.1f} |\n", name,
                         adaptive ? fmt::format(" {:g}", max_error) : "", tiles.patches, tiles.error_percent, tiles.ms,
                         strip.patches, strip.error_percent, strip.ms);
    plot[adaptive ? 1 : 0].points.emplace_back(tiles.patches, std::abs(tiles.error_percent));
    plot[adaptive ? 3 : 2].points.emplace_back(strip.patches, std::abs(strip.error_percent));
  }
  report.tables["patches"] = table;
  report.plots["sky_patches.svg"] = svg_plot("Error against patches", {"patches", true}, {"error, %", true}, plot);
}

}  // namespace bench
