// Accuracy and cost of the sky's models and tessellations, printed as the tables of docs/sky.md.

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <map>
#include <numbers>

#include "render/sky/hemisphere.h"
#include "render/sky/patches.h"
#include "render/sky/sky_model.h"
#include "render/sun/spectrum.h"
#include "tests/unit/table.h"

namespace {

using render::luminance;
using render::SkyModel;

constexpr double kPi = std::numbers::pi;
constexpr double kDeg = kPi / 180.0;

render::SunPosition sun_at(double elevation_deg) {
  render::SunPosition sun;
  sun.elevation_rad = sun.apparent_elevation_rad = elevation_deg * kDeg;
  return sun;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

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
  std::string text() const {
    if (count_ == 0) return "no data | no data";
    return fmt::format("{:.3f} | {:.4f}", std::sqrt(squared_ / count_) / (sum_ / count_), std::sqrt(color_ / count_));
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
    const auto truth = render::make_sky({.model = "reference", .turbidity = 2.5}, sun);
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

void print_models() {
  fmt::print(
      "| model | against reference: RMSE/mean | du'v' | 27 May 2013: RMSE/mean | du'v' | 24 Sep 2013: RMSE/mean | "
      "du'v' "
      "| ns per direction | ms per new sun |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const char* model : {"perez", "preetham", "preetham:rescaled", "cie:12", "scattering", "reference"}) {
    const render::SkyOptions options{.model = model, .turbidity = 2.5};
    constexpr int kSuns = 20;
    render::make_sky(options, sun_at(30.0));  // the air's own tables are made once
    auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kSuns; ++i) render::make_sky(options, sun_at(30.0 + i));
    const double ms = seconds_since(start) / kSuns * 1e3;
    const auto sky = render::make_sky(options, sun_at(30.0));
    constexpr int kRounds = 50;
    glm::dvec3 sum(0.0);
    start = std::chrono::steady_clock::now();
    for (int i = 0; i < kRounds; ++i) sum += render::horizontal_illuminance(*sky);
    const double ns = seconds_since(start) / kRounds / static_cast<double>(render::upper_hemisphere().size()) * 1e9;
    fmt::print("| {} | {} | {} | {} | {:.0f} | {:.2f} |\n", model, against_reference(options).text(),
               against_measurement(options, "2013-05-27").text(),
               against_measurement({.model = model, .turbidity = 2.0}, "2013-09-24").text(), sum.x > 0.0 ? ns : 0.0,
               ms);
  }
}

// Even in projected solid angle; the slit is 1 degree wide, from horizon to horizon through the zenith.
double seen_through_slit(const glm::dvec3& direction) {
  return std::abs(direction.x) < std::sin(0.5 * kDeg) ? 1.0 : 0.0;
}

double angle_to_slit_edge(const glm::dvec3& direction) {
  return std::abs(std::asin(std::min(std::abs(direction.x), 1.0)) - 0.5 * kDeg);
}

double exact_lux(const SkyModel& sky, bool slit) {
  constexpr int kRows = 700;
  constexpr int kSectors = 7200;
  double sum = 0.0;
  for (int row = 0; row < kRows; ++row) {
    const double sine2 = (row + 0.5) / kRows;
    for (int sector = 0; sector < (slit ? kSectors : kSectors / 10); ++sector) {
      const double azimuth = 2.0 * kPi * (sector + 0.5) / (slit ? kSectors : kSectors / 10);
      const glm::dvec3 view(std::sqrt(sine2) * std::sin(azimuth), std::sqrt(sine2) * std::cos(azimuth),
                            std::sqrt(1.0 - sine2));
      if (!slit || seen_through_slit(view) > 0.0) sum += luminance(sky.luminance_rgb(view));
    }
  }
  return sum * kPi / (kRows * (slit ? kSectors : kSectors / 10));
}

void print_tessellations() {
  const auto sky = render::make_sky({.turbidity = 3.0}, sun_at(35.0));
  const double open = exact_lux(*sky, false);
  const double slit = exact_lux(*sky, true);
  fmt::print(
      "| tessellation | patches, open sky | error of horizontal illuminance | ms | patches, 1 degree slit | error of "
      "light through it | ms |\n|---|---|---|---|---|---|---|\n");
  for (const auto& [name, max_error] : {std::pair<const char*, double>{"dome5728", 0.0},
                                        {"dome144", 0.0},
                                        {"geodesic", 0.02},
                                        {"geodesic", 0.005},
                                        {"geodesic", 0.001}}) {
    render::PatchOptions options;
    options.tessellation = name;
    if (max_error > 0.0) options.max_error = max_error;
    auto start = std::chrono::steady_clock::now();
    const render::SkyPatches tiles = render::make_patches(*sky, options);
    const double open_ms = seconds_since(start) * 1e3;
    options.visibility = {seen_through_slit, angle_to_slit_edge};
    start = std::chrono::steady_clock::now();
    const render::SkyPatches strip = render::make_patches(*sky, options);
    const double slit_ms = seconds_since(start) * 1e3;
    const auto error = [](const render::SkyPatches& patches, double truth) {
      return 100.0 * (luminance(patches.illuminance_rgb({0, 0, 1})) / truth - 1.0);
    };
    fmt::print("| {}{} | {} | {:+.2f} % | {:.1f} | {} | {:+.1f} % | {:.1f} |\n", name,
               max_error > 0.0 ? fmt::format(" {:g}", max_error) : "", tiles.patches().size(), error(tiles, open),
               open_ms, strip.patches().size(), error(strip, slit), slit_ms);
  }
}

void print_levels() {
  fmt::print("| sun elevation | sky, lux | sun on level ground, lux | together over USNO C171 |\n|---|---|---|---|\n");
  for (const auto& row : read_table(SKYSHAFT_SHARED_DATA "/sky_reference/illuminance-by-elevation.csv")) {
    const double elevation_deg = std::stod(row.at("elevation_deg"));
    if (std::fmod(elevation_deg + 18.0, 3.0) != 0.0 || elevation_deg < -12.0 || elevation_deg > 60.0) continue;
    const render::SunPosition sun = sun_at(elevation_deg);
    const double diffuse = luminance(render::horizontal_illuminance(*render::make_sky({.turbidity = 3.0}, sun)));
    const double direct =
        luminance(render::sun_light(sun, 3.0).illuminance_rgb) * std::max(std::sin(sun.elevation_rad), 0.0);
    fmt::print("| {:g} | {:.3g} | {:.3g} | {:.2f} |\n", elevation_deg, diffuse, direct,
               (diffuse + direct) / std::stod(row.at("sun_total_horizontal_lux_usno171")));
  }
}

}  // namespace

int main() {
  print_models();
  fmt::print("\n");
  print_tessellations();
  fmt::print("\n");
  print_levels();
  return 0;
}
