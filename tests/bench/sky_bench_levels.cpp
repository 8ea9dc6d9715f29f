#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/sky/hemisphere.h"
#include "render/sky/sky_model.h"
#include "render/sky/twilight.h"
#include "render/sun/refraction.h"
#include "render/sun/spectrum.h"
#include "tests/bench/sky_bench.h"
#include "tests/bench/svg_plot.h"

namespace bench {
namespace {

struct Level {
  double sky_lux;
  double sun_lux;  // on level ground
};

render::SunPosition refracted(double elevation_deg) {
  render::SunPosition sun = sun_at(elevation_deg);
  sun.apparent_elevation_rad = render::apparent_elevation(sun.elevation_rad, {});
  return sun;
}

double beam_lux(const render::SunPosition& sun, double turbidity) {
  return render::luminance(render::sun_light(sun, turbidity).illuminance_rgb) *
         std::max(std::sin(sun.apparent_elevation_rad), 0.0);
}

Level level(double elevation_deg, double turbidity) {
  const render::SunPosition sun = refracted(elevation_deg);
  const auto sky = render::make_sky({.turbidity = turbidity}, sun);
  return {render::luminance(render::horizontal_illuminance(*sky)), beam_lux(sun, turbidity)};
}

}  // namespace

void measure_levels(Report& report) {
  // The reference sky's aerosol is 0.0461 (T - 1.74), sun_light()'s 0.04608 T - 0.04586: the same for this less.
  constexpr double kSkysAir = 0.745;
  std::string table =
      "| sun elevation | sky, lux | sun on level ground, lux | together over USNO C171 | with the sky's own aerosol "
      "before the sun |\n|---|---|---|---|---|\n";
  for (double elevation = -12.0; elevation <= 60.0; elevation += 3.0) {
    const Level now = level(elevation, render::kClearTurbidity);
    const double published = render::clear_illuminance_lux(elevation * kDeg);
    table +=
        fmt::format("| {:g} | {:.3g} | {:.3g} | {:.2f} | {:.2f} |\n", elevation, now.sky_lux, now.sun_lux,
                    (now.sky_lux + now.sun_lux) / published,
                    (now.sky_lux + beam_lux(refracted(elevation), render::kClearTurbidity - kSkysAir)) / published);
  }
  report.tables["levels"] = table;
  std::vector<Series> plot;
  for (const double turbidity : {2.0, render::kClearTurbidity, 3.0, 4.0, 6.0}) {
    Series series{fmt::format("turbidity {:g}", turbidity), {}, true};
    for (double elevation = -12.0; elevation <= 60.0; elevation += 1.0) {
      const Level now = level(elevation, turbidity);
      series.points.emplace_back(elevation,
                                 (now.sky_lux + now.sun_lux) / render::clear_illuminance_lux(elevation * kDeg));
    }
    plot.push_back(std::move(series));
  }
  report.plots["sky_levels.svg"] =
      svg_plot("Sun and sky on level ground over Circular 171", {"sun elevation, degrees"}, {"ratio"}, plot);
}

}  // namespace bench
