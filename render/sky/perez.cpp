#include "render/sky/perez.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/base/check.h"

namespace render {
namespace {

constexpr int kBins = 8;
constexpr double kLeastBrightness = 0.01;
constexpr double kMostBrightness = 0.6;
constexpr double kClearest = 12.0;

// Perez 1993, table 1: x = x1 + x2 Z + delta (x3 + x4 Z).
struct Row {
  std::array<double, 4> a, b, c, d, e;
};
constexpr std::array<Row, kBins> kCoefficients = {{
    {{1.3525, -0.2576, -0.2690, -1.4366},
     {-0.7670, 0.0007, 1.2734, -0.1233},
     {2.8000, 0.6004, 1.2375, 1.0000},
     {1.8734, 0.6297, 0.9738, 0.2809},
     {0.0356, -0.1246, -0.5718, 0.9938}},
    {{-1.2219, -0.7730, 1.4148, 1.1016},
     {-0.2054, 0.0367, -3.9128, 0.9156},
     {6.9750, 0.1774, 6.4477, -0.1239},
     {-1.5798, -0.5081, -1.7812, 0.1080},
     {0.2624, 0.0672, -0.2190, -0.4285}},
    {{-1.1000, -0.2515, 0.8952, 0.0156},
     {0.2782, -0.1812, -4.5000, 1.1766},
     {24.7219, -13.0812, -37.7000, 34.8438},
     {-5.0000, 1.5218, 3.9229, -2.6204},
     {-0.0156, 0.1597, 0.4199, -0.5562}},
    {{-0.5484, -0.6654, -0.2672, 0.7117},
     {0.7234, -0.6219, -5.6812, 2.6297},
     {33.3389, -18.3000, -62.2500, 52.0781},
     {-3.5000, 0.0016, 1.1477, 0.1062},
     {0.4659, -0.3296, -0.0876, -0.0329}},
    {{-0.6000, -0.3566, -2.5000, 2.3250},
     {0.2937, 0.0496, -5.6812, 1.8415},
     {21.0000, -4.7656, -21.5906, 7.2492},
     {-3.5000, -0.1554, 1.4062, 0.3988},
     {0.0032, 0.0766, -0.0656, -0.1294}},
    {{-1.0156, -0.3670, 1.0078, 1.4051},
     {0.2875, -0.5328, -3.8500, 3.3750},
     {14.0000, -0.9999, -7.1406, 7.5469},
     {-3.4000, -0.1078, -1.0750, 1.5702},
     {-0.0672, 0.4016, 0.3017, -0.4844}},
    {{-1.0000, 0.0211, 0.5025, -0.5119},
     {-0.3000, 0.1922, 0.7023, -1.6317},
     {19.0000, -5.0000, 1.2438, -1.9094},
     {-4.0000, 0.0250, 0.3844, 0.2656},
     {1.0468, -0.3788, -2.4517, 1.4656}},
    {{-1.0500, 0.0289, 0.4260, 0.3590},
     {-0.3250, 0.1156, 0.7781, 0.0025},
     {31.0625, -14.5000, -46.1148, 55.3750},
     {-7.2312, 0.4050, 13.3500, 0.6234},
     {1.5000, -0.6426, 1.8564, 0.5636}},
}};

// Lower limits of the bins [lo, hi) (Perez 1993, table 1).
constexpr std::array<double, kBins> kBinFloor = {1.0, 1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2};
// Where each bin's coefficients count alone when interpolating; the open last bin as wide as its neighbour.
constexpr std::array<double, kBins> kBinCentre = {1.0325, 1.1475, 1.365, 1.725, 2.375, 3.65, 5.35, 7.05};

// Perez 1990, table 4: efficacy = a + b W + c cos Z (diffuse) or exp(5.73 Z - 5) (direct) + d ln delta or delta.
constexpr std::array<std::array<double, 4>, kBins> kDiffuseEfficacy = {{{97.24, -0.46, 12.00, -8.91},
                                                                        {107.22, 1.15, 0.59, -3.95},
                                                                        {104.97, 2.96, -5.53, -8.77},
                                                                        {102.39, 5.59, -13.95, -13.90},
                                                                        {100.71, 5.94, -22.75, -23.74},
                                                                        {106.42, 3.83, -36.15, -28.83},
                                                                        {141.88, 1.90, -53.24, -14.03},
                                                                        {152.23, 0.35, -45.27, -7.98}}};
constexpr std::array<std::array<double, 4>, kBins> kDirectEfficacy = {{{57.20, -4.55, -2.98, 117.12},
                                                                       {98.99, -3.46, -1.21, 12.38},
                                                                       {109.83, -4.90, -1.71, -8.81},
                                                                       {110.34, -5.84, -1.99, -4.56},
                                                                       {106.36, -3.97, -1.75, -6.16},
                                                                       {107.19, -1.25, -1.51, -26.73},
                                                                       {105.75, 0.77, -1.26, -34.44},
                                                                       {101.18, 1.58, -1.10, -8.29}}};
constexpr double kPrecipitableWaterCm = 2.0;

int bin_of(double clearness) {
  int bin = kBins - 1;
  while (bin > 0 && clearness < kBinFloor[static_cast<std::size_t>(bin)]) --bin;
  return bin;
}

double linear(const std::array<double, 4>& x, double zenith, double delta) {
  return x[0] + x[1] * zenith + delta * (x[2] + x[3] * zenith);
}

// Brightness inside the range in which the bin's b is negative: beyond it luminance overflows at the horizon.
double valid_brightness(int bin, double delta, double zenith) {
  constexpr double kMargin = 0.001;
  const auto& b = kCoefficients[static_cast<std::size_t>(bin)].b;
  if (bin >= 1 && bin <= 4) delta = std::max(delta, 0.2);  // the authors' patch for dark, half clear skies
  const double slope = b[2] + b[3] * zenith;
  const double limit = (-kMargin - b[0] - b[1] * zenith) / slope;
  if (linear(b, zenith, delta) <= -kMargin) return delta;
  return std::clamp(limit, kLeastBrightness, kMostBrightness);
}

PerezShape bin_shape(int bin, double brightness, double zenith) {
  const Row& row = kCoefficients[static_cast<std::size_t>(bin)];
  const double delta = valid_brightness(bin, brightness, zenith);
  PerezShape shape{linear(row.a, zenith, delta), std::min(linear(row.b, zenith, delta), -0.001),
                   linear(row.c, zenith, delta), linear(row.d, zenith, delta), linear(row.e, zenith, delta)};
  if (bin == 0) {  // Perez 1993, eq. 7 and 8
    shape.c = std::exp(std::pow(delta * (row.c[0] + row.c[1] * zenith), row.c[2])) - row.c[3];
    shape.d = -std::exp(delta * (row.d[0] + row.d[1] * zenith)) + row.d[2] + delta * row.d[3];
  }
  return shape;
}

// Relative air mass after Kasten 1966, the one that Perez's tables were fitted with.
double kasten_air_mass(double zenith_rad) {
  const double zenith_deg = std::clamp(zenith_rad * 180.0 / std::numbers::pi, 0.0, 90.0);
  return 1.0 / (std::cos(zenith_deg / 180.0 * std::numbers::pi) + 0.15 * std::pow(93.885 - zenith_deg, -1.253));
}

double clamped_brightness(double brightness) {
  return std::clamp(brightness, kLeastBrightness, kMostBrightness);
}

double held_clearness(double clearness) {
  return std::clamp(clearness, 1.0, kClearest);
}

double clearness_cubic(double sun_zenith_rad) {
  const double zenith = std::clamp(sun_zenith_rad, 0.0, std::numbers::pi / 2.0);
  return 1.041 * zenith * zenith * zenith;
}

// Between which bins' centres a clearness lies.
struct BinPosition {
  std::size_t low;
  double weight;  // of the bin after it
};

BinPosition position_of(double clearness) {
  const double held = std::clamp(clearness, kBinCentre.front(), kBinCentre.back());
  std::size_t low = 0;
  while (low + 2 < kBinCentre.size() && held > kBinCentre[low + 1]) ++low;
  return {low, (held - kBinCentre[low]) / (kBinCentre[low + 1] - kBinCentre[low])};
}

// The efficacy that `of_bin` gives each bin, by the bin that clearness lies in or between the nearest two.
template <typename OfBin>
double efficacy(double clearness, PerezBins bins, const OfBin& of_bin) {
  if (bins == PerezBins::Original) return of_bin(static_cast<std::size_t>(bin_of(clearness)));
  const BinPosition at = position_of(clearness);
  return std::lerp(of_bin(at.low), of_bin(at.low + 1), at.weight);
}

double mix(double from, double to, double weight) {
  return from + (to - from) * weight;
}

}  // namespace

double perez_luminance(const PerezShape& shape, double cos_view_zenith, double gamma_rad, double cos_gamma) {
  const double gradation = 1.0 + shape.a * std::exp(shape.b / std::max(cos_view_zenith, 1e-3));
  const double indicatrix = 1.0 + shape.c * std::exp(shape.d * gamma_rad) + shape.e * cos_gamma * cos_gamma;
  return gradation * indicatrix;
}

double sky_clearness(double dni_wm2, double dhi_wm2, double sun_zenith_rad) {
  CHECK(std::isfinite(dni_wm2));
  CHECK(std::isfinite(dhi_wm2));
  CHECK(std::isfinite(sun_zenith_rad));
  const double direct = std::max(dni_wm2, 0.0);
  const double diffuse = std::max(dhi_wm2, 0.0);
  if (diffuse <= 0.0) return direct > 0.0 ? kClearest : 1.0;
  const double cubic = clearness_cubic(sun_zenith_rad);
  return held_clearness(((diffuse + direct) / diffuse + cubic) / (1.0 + cubic));
}

double sky_brightness(double dhi_wm2, double sun_zenith_rad, double extraterrestrial_normal_wm2) {
  CHECK(extraterrestrial_normal_wm2 > 0.0);
  const double air_mass = kasten_air_mass(sun_zenith_rad);
  return clamped_brightness(std::max(dhi_wm2, 0.0) * air_mass / extraterrestrial_normal_wm2);
}

double dni_from_clearness(double clearness, double dhi_wm2, double sun_zenith_rad) {
  const double cubic = clearness_cubic(sun_zenith_rad);
  return std::max(dhi_wm2 * (held_clearness(clearness) - 1.0) * (1.0 + cubic), 0.0);
}

double dhi_from_brightness(double brightness, double sun_zenith_rad, double extraterrestrial_normal_wm2) {
  return clamped_brightness(brightness) * extraterrestrial_normal_wm2 / kasten_air_mass(sun_zenith_rad);
}

PerezShape perez_shape(double clearness, double brightness, double sun_zenith_rad, PerezBins bins) {
  CHECK(std::isfinite(clearness));
  CHECK(std::isfinite(brightness));
  CHECK(std::isfinite(sun_zenith_rad));
  const double zenith = std::clamp(sun_zenith_rad, 0.0, std::numbers::pi / 2.0);
  brightness = clamped_brightness(brightness);
  if (bins == PerezBins::Original) return bin_shape(bin_of(clearness), brightness, zenith);
  const BinPosition at = position_of(clearness);
  const PerezShape from = bin_shape(static_cast<int>(at.low), brightness, zenith);
  const PerezShape to = bin_shape(static_cast<int>(at.low) + 1, brightness, zenith);
  return {mix(from.a, to.a, at.weight), mix(from.b, to.b, at.weight), mix(from.c, to.c, at.weight),
          mix(from.d, to.d, at.weight), mix(from.e, to.e, at.weight)};
}

PerezShape without_dark_zenith(PerezShape shape) {
  constexpr double kLeastGradation = 1e-4;
  shape.a = std::max(shape.a, (kLeastGradation - 1.0) * std::exp(-shape.b));
  return shape;
}

double held_brightness(double clearness, double brightness, double sun_zenith_rad) {
  const double zenith = std::clamp(sun_zenith_rad, 0.0, std::numbers::pi / 2.0);
  return valid_brightness(bin_of(clearness), clamped_brightness(brightness), zenith);
}

double diffuse_efficacy(double clearness, double brightness, double sun_zenith_rad, PerezBins bins) {
  const double cosine = std::cos(sun_zenith_rad);
  const double log_brightness = std::log(clamped_brightness(brightness));
  return efficacy(clearness, bins, [&](std::size_t bin) {
    const auto& k = kDiffuseEfficacy[bin];
    return k[0] + k[1] * kPrecipitableWaterCm + k[2] * cosine + k[3] * log_brightness;
  });
}

double direct_efficacy(double clearness, double brightness, double sun_zenith_rad, PerezBins bins) {
  const double low_sun = std::exp(5.73 * sun_zenith_rad - 5.0);
  return efficacy(clearness, bins, [&](std::size_t bin) {
    const auto& k = kDirectEfficacy[bin];
    return std::max(k[0] + k[1] * kPrecipitableWaterCm + k[2] * low_sun + k[3] * clamped_brightness(brightness), 0.0);
  });
}

}  // namespace render
