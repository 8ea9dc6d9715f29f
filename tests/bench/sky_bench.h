#pragma once

#include <cmath>
#include <ctime>
#include <map>
#include <numbers>
#include <string>

#include "render/sun/sun.h"

namespace bench {

// What the benchmarks of sun and sky write: Markdown by the name of its place in docs/measurements/sky.md, SVG by file
// name.
struct Report {
  std::map<std::string, std::string> tables;
  std::map<std::string, std::string> plots;
};

void measure_sun(Report& report);
void measure_models(Report& report);
void measure_levels(Report& report);
void measure_patches(Report& report);

inline constexpr double kDeg = std::numbers::pi / 180.0;

inline render::SunPosition sun_at(double elevation_deg) {
  render::SunPosition sun;
  sun.elevation_rad = sun.apparent_elevation_rad = elevation_deg * kDeg;
  return sun;
}

// Processor seconds since `start`: they hold on a busy machine too.
inline double cpu_seconds_since(std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace bench
