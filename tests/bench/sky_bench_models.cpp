#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "render/sky/hemisphere.h"
#include "render/sky/sky_model.h"
#include "render/sun/spectrum.h"
#include "tests/bench/sky_bench.h"
#include "tests/bench/svg_plot.h"
#include "tests/testing/table.h"

namespace bench {
namespace {

using render::luminance;
using render::SkyModel;

// RMSE over mean of luminance and root mean square distance in u'v', gathered sample by sample.
class Disagreement {
 public:
  void add(const glm::dvec3& xyz, const glm::dvec3& truth) {
    squared_ += (xyz.y - truth.y) * (xyz.y - truth.y);
    sum_ += truth.y;
    const double a = xyz.x + 15.0 * xyz.y + 3.0 * xyz.z;
    const double b = truth.x + 15.0 * truth.y + 3.0 * truth.z;
    color_ += std::pow(4.0 * (xyz.x / a - truth.x / b), 2.0) + std::pow(9.0 * (xyz.y / a - truth.y / b), 2.0);
    ++count_;
  }
  double luminance() const { return std::sqrt(squared_ / count_) / (sum_ / count_); }
  std::string text() const {
    if (count_ == 0) return "no data | no data";
    return fmt::format("{:.3f} | {:.4f}", luminance(), std::sqrt(color_ / count_));
  }

 private:
  double squared_ = 0.0;
  double sum_ = 0.0;
  double color_ = 0.0;
  int count_ = 0;
};

Disagreement against_reference(const render::SkyOptions& options) {
  Disagreement result;
  for (const double elevation_deg : {10.0, 25.0, 40.0, 55.0, 70.0}) {
    const render::SunPosition sun = sun_at(elevation_deg);
    const auto sky = render::make_sky(options, sun);
    const auto truth = render::make_sky({.model = "reference", .turbidity = options.turbidity}, sun);
    for (const render::SolidAngleSample& sample : render::upper_hemisphere()) {
      result.add(sky->luminance_xyz(sample.direction_in_world), truth->luminance_xyz(sample.direction_in_world));
    }
  }
  return result;
}

Disagreement against_measurement(const render::SkyOptions& options, const std::string& day) {
  std::map<std::string, std::unique_ptr<SkyModel>> skies;
  Disagreement result;
  for (const auto& row : read_table(SKYSHAFT_SHARED_DATA "/sky_measured/kider-sky.csv")) {
    if (row.at("scan").rfind(day, 0) != 0 || row.at("flag").find("bad_north") != std::string::npos) continue;
    const auto number = [&row](const char* name) { return std::stod(row.at(name)); };
    auto& sky = skies[row.at("scan")];
    if (!sky) sky = render::make_sky(options, sun_at(number("sun_elevation_deg")));
    const double azimuth = number("rel_azimuth_deg") * kDeg;
    const double elevation = number("view_elevation_deg") * kDeg;
    const glm::dvec3 view(std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
                          std::sin(elevation));
    result.add(sky->luminance_xyz(view), {number("X_cdm2"), number("Y_luminance_cdm2"), number("Z_cdm2")});
  }
  return result;
}

struct Cost {
  double ns_per_direction;
  double ms_per_sun;
};

Cost cost_of(const render::SkyOptions& options) {
  constexpr int kSuns = 20;
  constexpr int kRounds = 50;
  render::make_sky(options, sun_at(30.0));  // the medium's own tables are made once
  std::clock_t start = std::clock();
  for (int i = 0; i < kSuns; ++i) render::make_sky(options, sun_at(30.0 + i));
  const double ms = cpu_seconds_since(start) / kSuns * 1e3;
  const auto sky = render::make_sky(options, sun_at(30.0));
  glm::dvec3 sum(0.0);
  start = std::clock();
  for (int i = 0; i < kRounds; ++i) sum += render::horizontal_illuminance(*sky);
  const double ns = cpu_seconds_since(start) / kRounds / static_cast<double>(render::upper_hemisphere().size()) * 1e9;
  return {std::isfinite(sum.x) ? ns : 0.0, ms};
}

// Luminance up the sun's side and down the other, the sun at 40 degrees.
Series along_meridian(const std::string& model) {
  const auto sky = render::make_sky({.model = model}, sun_at(40.0));
  Series series{model, {}, true};
  for (int angle = 1; angle < 180; ++angle) {
    const glm::dvec3 view(0.0, std::cos(angle * kDeg), std::sin(angle * kDeg));
    series.points.emplace_back(angle, luminance(sky->luminance_rgb(view)));
  }
  return series;
}

void measure_turbidity(Report& report) {
  std::vector<Series> plot{{"perez", {}, true}, {"reference", {}, true}};
  for (Series& series : plot) {
    for (double turbidity = 1.9; turbidity < 3.55; turbidity += 0.1) {
      const Disagreement found = against_measurement({.model = series.name, .turbidity = turbidity}, "2013-05-27");
      series.points.emplace_back(turbidity, found.luminance());
    }
  }
  report.plots["sky_turbidity.svg"] =
      svg_plot("27 May 2013: error by the turbidity that is given", {"turbidity (Linke)"}, {"RMSE over mean"}, plot);
}

}  // namespace

void measure_models(Report& report) {
  std::string table =
      "| model | against reference: RMSE/mean | du'v' | 27 May 2013: RMSE/mean | du'v' | 24 Sep 2013: RMSE/mean | "
      "du'v' | ns per direction | ms per new sun |\n|---|---|---|---|---|---|---|---|---|\n";
  std::vector<Series> cost_plot;
  std::vector<Series> meridian;
  for (const char* model : {"perez", "preetham", "preetham:rescaled", "cie:12", "scattering", "reference"}) {
    const render::SkyOptions options{.model = model};
    const Cost cost = cost_of(options);
    const Disagreement may = against_measurement(options, "2013-05-27");
    table += fmt::format("| {} | {} | {} | {} | {:.0f} | {:.2f} |\n", model, against_reference(options).text(),
                         may.text(), against_measurement({.model = model, .turbidity = 2.0}, "2013-09-24").text(),
                         cost.ns_per_direction, cost.ms_per_sun);
    cost_plot.push_back({model, {{cost.ms_per_sun, may.luminance()}}, false});
    meridian.push_back(along_meridian(model));
  }
  report.tables["models"] = table;
  report.plots["sky_cost.svg"] =
      svg_plot("27 May 2013: error against cost", {"ms per new sun", true}, {"RMSE over mean", true}, cost_plot);
  report.plots["sky_meridian.svg"] = svg_plot("Across the sky through a sun at 40 degrees",
                                              {"degrees from the horizon under the sun"}, {"cd/m²", true}, meridian);
  measure_turbidity(report);
}

}  // namespace bench
