#include "render/sky/twilight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/base/angles.h"
#include "render/sky/smooth_step.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

constexpr double kBlendHalfDeg = 0.5;
constexpr double kMeanMoonDistanceM = 3.844e8;

// log10 of the illuminance as a cubic of elevation / 90 degrees, from `floor_deg` upwards (Circular 171, table 1).
struct Piece {
  double floor_deg;
  double l0, l1, l2, l3;
};
constexpr std::array<Piece, 6> kSun = {{{-18.0, 13.84, 262.72, 1447.42, 2797.93},
                                        {-12.0, 2.70, 12.17, -431.69, -1899.83},
                                        {-5.0, 2.88, 21.81, -258.11, -858.36},
                                        {-0.8, 2.88, 22.26, -207.64, 1034.30},
                                        {5.0, 3.05, 13.28, -45.98, 64.33},
                                        {20.0, 3.74, 3.97, -4.07, 1.47}}};
constexpr std::array<Piece, 3> kFullMoon = {
    {{-0.8, -2.79, 24.27, -252.95, 1321.29}, {5.0, -2.58, 12.58, -42.58, 59.06}, {20.0, -1.95, 4.06, -4.24, 1.56}}};

double value(const Piece& piece, double elevation_deg) {
  const double x = elevation_deg / 90.0;
  return piece.l0 + x * (piece.l1 + x * (piece.l2 + x * piece.l3));
}

template <std::size_t N>
double blended(const std::array<Piece, N>& pieces, double elevation_deg) {
  double result = value(pieces[0], elevation_deg);
  for (std::size_t i = 1; i < N; ++i) {
    const double floor = pieces[i].floor_deg;
    const double weight = smooth_step(floor - kBlendHalfDeg, floor + kBlendHalfDeg, elevation_deg);
    if (weight > 0.0) result += weight * (value(pieces[i], elevation_deg) - result);
  }
  return result;
}

}  // namespace

double clear_illuminance_lux(double sun_elevation_rad) {
  constexpr double kFloorDeg = -18.0;
  const double elevation_deg = std::min(sun_elevation_rad / kRadPerDeg, 90.0);
  if (elevation_deg >= kFloorDeg) return std::pow(10.0, blended(kSun, elevation_deg));
  const double slope = (blended(kSun, kFloorDeg + 0.01) - blended(kSun, kFloorDeg)) / 0.01;
  return std::pow(10.0, blended(kSun, kFloorDeg) + slope * (elevation_deg - kFloorDeg));
}

double moon_illuminance_lux(double moon_elevation_rad, double phase_angle_rad, double distance_m) {
  const double elevation_deg = std::min(moon_elevation_rad / kRadPerDeg, 90.0);
  const double risen = smooth_step(-0.8, 0.2, elevation_deg);
  if (risen <= 0.0) return 0.0;
  const double phase_deg = phase_angle_rad / kRadPerDeg;
  const double log_phase = -0.00868 * phase_deg - 2.2e-9 * std::pow(phase_deg, 4.0);
  const double nearness = kMeanMoonDistanceM / distance_m;
  return risen * nearness * nearness * std::pow(10.0, blended(kFullMoon, elevation_deg) + log_phase);
}

double diffuse_level_lux(double model_lux, const SunPosition& sun, double turbidity) {
  const double elevation = sun.elevation_rad;
  const double day = smooth_step(2.0 * kRadPerDeg, 15.0 * kRadPerDeg, elevation);
  if (day >= 1.0) return model_lux;
  const double direct =
      luminance(sun_light(sun, turbidity).illuminance_rgb) * std::max(std::sin(sun.apparent_elevation_rad), 0.0);
  const double total = clear_illuminance_lux(elevation);
  const double measured = std::max(total - direct, 0.3 * total);  // hazy or not, some of it comes from the sky
  return std::exp(day * std::log(std::max(model_lux, 1.0)) + (1.0 - day) * std::log(measured));
}

double twilight_dimming(double sun_elevation_rad) {
  return clear_illuminance_lux(std::min(sun_elevation_rad, 0.0)) / clear_illuminance_lux(0.0);
}

}  // namespace render
