#include "render/sky/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <list>
#include <mutex>
#include <numbers>

#include "render/medium/medium.h"
#include "render/sky/hemisphere.h"

namespace render {
namespace {

constexpr double kMolecularScaleM = 8000.0;
constexpr double kAerosolScaleM = 1200.0;
constexpr double kAerosolAlbedo = 0.92;    // continental average (OPAC, Hess 1998)
constexpr double kAngstromExponent = 1.3;  // Preetham 1999, A.1
constexpr double kOzonePeakM = 25000.0;    // a tent from 10 to 40 km
constexpr double kOzoneHalfWidthM = 15000.0;
constexpr double kOzoneMoleculesPerM2 = 300.0 * 2.687e20;  // 300 Dobson units
constexpr double kSunRadiusRad = 0.00465;

// Ozone cross sections in 1e-25 m2 at 233 K (Serdyuchenko et al. 2014), means over 10 nm around each band.
constexpr Bands kOzoneCrossSection = {0.011, 0.070, 0.299, 0.838, 1.871, 3.296, 4.535, 4.662, 2.939, 1.663, 0.844};

constexpr int kColumnRadii = 48;
constexpr int kColumnAngles = 128;
constexpr int kMultipleRadii = 10;
constexpr int kMultipleAngles = 24;

double height_of_horizon(double radius_m) {
  return std::sqrt(std::max(radius_m * radius_m - Atmosphere::kGroundRadiusM * Atmosphere::kGroundRadiusM, 0.0));
}
const double kTopHorizonM = height_of_horizon(Atmosphere::kTopRadiusM);

double distance_to_top(double radius_m, double mu) {
  const double top = Atmosphere::kTopRadiusM;
  return -radius_m * mu + std::sqrt(std::max(radius_m * radius_m * (mu * mu - 1.0) + top * top, 0.0));
}

// Share of the sun's disc above the solid Earth's horizon seen from radius_m.
double visible_disc(double radius_m, double mu) {
  const double horizon = -height_of_horizon(radius_m) / radius_m;  // cosine of the horizon's zenith angle
  const double elevation = std::asin(std::clamp(mu, -1.0, 1.0)) - std::asin(horizon);
  const double x = std::clamp(elevation / kSunRadiusRad, -1.0, 1.0);
  return 0.5 + (std::asin(x) + x * std::sqrt(1.0 - x * x)) / std::numbers::pi;
}

std::size_t cell_index(int row, int column, int columns) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
}

struct Cell {
  int low;
  double weight;
};

Cell cell(double position, int count) {
  const double held = std::clamp(position, 0.0, count - 1.0);
  const int low = std::min(static_cast<int>(held), count - 2);
  return {low, held - low};
}

// Multiple scattering is tabulated from the sun 24 degrees below the horizon to the zenith, densest at the horizon.
double angle_position(double mu) {
  const double low = -0.41;
  const double t = mu < 0.0 ? 0.4 * (1.0 - std::sqrt(std::min(mu / low, 1.0))) : 0.4 + 0.6 * std::sqrt(mu);
  return t * (kMultipleAngles - 1);
}

double mu_at(double position) {
  const double t = position / (kMultipleAngles - 1);
  if (t < 0.4) return -0.41 * (1.0 - t / 0.4) * (1.0 - t / 0.4);
  return (t - 0.4) / 0.6 * (t - 0.4) / 0.6;
}

}  // namespace

double Atmosphere::aerosol_depth_at_1um(double turbidity) {
  return std::max(0.0461 * (std::clamp(turbidity, 1.0, 20.0) - 1.74), 0.0);
}

Atmosphere::Atmosphere(double turbidity, double ground_albedo) : ground_albedo_(ground_albedo) {
  const double beta = aerosol_depth_at_1um(turbidity);
  for (std::size_t i = 0; i < kBandCount; ++i) {
    const double um = band_um(i);
    const double um2 = um * um;
    // Optical depth of the molecules: Hansen & Travis 1974, eq. 2.30.
    const double molecular_depth = 0.008569 / (um2 * um2) * (1.0 + 0.0113 / um2 + 0.00013 / (um2 * um2));
    molecular_scattering_[i] = molecular_depth / kMolecularScaleM;
    aerosol_extinction_[i] = beta * std::pow(um, -kAngstromExponent) / kAerosolScaleM;
    aerosol_scattering_[i] = kAerosolAlbedo * aerosol_extinction_[i];
    ozone_absorption_[i] = kOzoneCrossSection[i] * 1e-25 * kOzoneMoleculesPerM2 / kOzoneHalfWidthM;
  }
  tabulate_columns();
  tabulate_multiple_scattering();
}

std::shared_ptr<const Atmosphere> Atmosphere::shared(double turbidity) {
  constexpr std::size_t kKept = 4;
  static std::mutex mutex;
  static std::list<std::pair<double, std::shared_ptr<const Atmosphere>>> kept;
  const std::lock_guard lock(mutex);
  for (const auto& [key, atmosphere] : kept) {
    if (key == turbidity) return atmosphere;
  }
  kept.emplace_front(turbidity, std::make_shared<const Atmosphere>(turbidity));
  if (kept.size() > kKept) kept.pop_back();
  return kept.front().second;
}

Atmosphere::Columns Atmosphere::densities(double radius_m) const {
  const double height = std::max(radius_m - kGroundRadiusM, 0.0);
  return {std::exp(-height / kMolecularScaleM), std::exp(-height / kAerosolScaleM),
          std::max(1.0 - std::abs(height - kOzonePeakM) / kOzoneHalfWidthM, 0.0)};
}

Atmosphere::Point Atmosphere::point(double radius_m) const {
  const Columns density = densities(radius_m);
  Point at;
  for (std::size_t i = 0; i < kBandCount; ++i) {
    at.molecular_scattering[i] = molecular_scattering_[i] * density.molecules_m;
    at.aerosol_scattering[i] = aerosol_scattering_[i] * density.aerosol_m;
    at.extinction[i] = at.molecular_scattering[i] + aerosol_extinction_[i] * density.aerosol_m +
                       ozone_absorption_[i] * density.ozone_m;
  }
  return at;
}

Bands Atmosphere::transmittance(const Columns& columns) const {
  Bands result;
  for (std::size_t i = 0; i < kBandCount; ++i) {
    result[i] = std::exp(-(molecular_scattering_[i] * columns.molecules_m + aerosol_extinction_[i] * columns.aerosol_m +
                           ozone_absorption_[i] * columns.ozone_m));
  }
  return result;
}

double Atmosphere::molecular_phase(double cos_theta) const {
  return phase(PhaseFunction::Rayleigh, 0.0, cos_theta);
}

// Two lobes: a narrow one of large particles and a broad one, with a little light sent back.
double Atmosphere::aerosol_phase(double cos_theta) const {
  return 0.25 * phase(PhaseFunction::HenyeyGreenstein, 0.90, cos_theta) +
         0.70 * phase(PhaseFunction::HenyeyGreenstein, 0.60, cos_theta) +
         0.05 * phase(PhaseFunction::HenyeyGreenstein, -0.20, cos_theta);
}

Atmosphere::Reach Atmosphere::reach(double radius_m, double mu) {
  const double to_ground = radius_m * radius_m * (mu * mu - 1.0) + kGroundRadiusM * kGroundRadiusM;
  if (mu < 0.0 && to_ground >= 0.0) return {std::max(-radius_m * mu - std::sqrt(to_ground), 0.0), true};
  return {distance_to_top(radius_m, mu), false};
}

Atmosphere::Columns Atmosphere::integrate_columns(double radius_m, double mu) const {
  constexpr int kSteps = 64;
  const double length = distance_to_top(radius_m, mu);
  Columns sum;
  for (int i = 0; i < kSteps; ++i) {
    // Steps lengthen with the square of the distance: near the ground the air changes fastest.
    const double s = (i + 0.5) / kSteps;
    const double t = length * s * s;
    const double step = 2.0 * length * s / kSteps;
    const double radius = std::sqrt(radius_m * radius_m + t * t + 2.0 * radius_m * mu * t);
    const Columns density = densities(radius);
    sum.molecules_m += density.molecules_m * step;
    sum.aerosol_m += density.aerosol_m * step;
    sum.ozone_m += density.ozone_m * step;
  }
  return sum;
}

// Rows over the distance to the horizon, columns over the distance to the top (Bruneton & Neyret 2008, section 4).
void Atmosphere::tabulate_columns() {
  columns_.resize(static_cast<std::size_t>(kColumnRadii) * kColumnAngles);
  for (int row = 0; row < kColumnRadii; ++row) {
    const double rho = kTopHorizonM * row / (kColumnRadii - 1);
    const double radius = std::sqrt(rho * rho + kGroundRadiusM * kGroundRadiusM);
    const double nearest = kTopRadiusM - radius;
    const double farthest = rho + kTopHorizonM;
    for (int column = 0; column < kColumnAngles; ++column) {
      const double distance = nearest + (farthest - nearest) * column / (kColumnAngles - 1);
      const double mu =
          distance <= 0.0 ? 1.0
                          : (kTopHorizonM * kTopHorizonM - rho * rho - distance * distance) / (2.0 * radius * distance);
      columns_[cell_index(row, column, kColumnAngles)] = integrate_columns(radius, std::clamp(mu, -1.0, 1.0));
    }
  }
}

Atmosphere::Columns Atmosphere::columns_to_top(double radius_m, double mu) const {
  const double rho = height_of_horizon(radius_m);
  const double nearest = kTopRadiusM - radius_m;
  const double farthest = rho + kTopHorizonM;
  const double along = farthest > nearest ? (distance_to_top(radius_m, mu) - nearest) / (farthest - nearest) : 0.0;
  const Cell row = cell(rho / kTopHorizonM * (kColumnRadii - 1), kColumnRadii);
  const Cell column = cell(along * (kColumnAngles - 1), kColumnAngles);
  Columns result;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const double weight = (i ? row.weight : 1.0 - row.weight) * (j ? column.weight : 1.0 - column.weight);
      const Columns& at = columns_[cell_index(row.low + i, column.low + j, kColumnAngles)];
      result.molecules_m += weight * at.molecules_m;
      result.aerosol_m += weight * at.aerosol_m;
      result.ozone_m += weight * at.ozone_m;
    }
  }
  return result;
}

Bands Atmosphere::sunlight(double radius_m, double mu) const {
  const double visible = visible_disc(radius_m, mu);
  if (visible <= 0.0) return {};
  const double horizon = -height_of_horizon(radius_m) / radius_m;
  Bands result = transmittance(columns_to_top(radius_m, std::max(mu, horizon)));
  for (double& value : result) value *= visible;
  return result;
}

// Mean over all directions of the light scattered once towards a point, and of the scattering along the way, summed as
// the geometric series of all further scatterings.
Bands Atmosphere::scatter_twice(double radius_m, double mu) const {
  constexpr int kDirections = 40;
  constexpr int kSteps = 16;
  Bands light{};
  Bands returned{};
  const glm::dvec3 sun(std::sqrt(std::max(1.0 - mu * mu, 0.0)), 0.0, mu);
  for (int k = 0; k < kDirections; ++k) {
    const double z = 1.0 - 2.0 * (k + 0.5) / kDirections;
    const double azimuth = k * std::numbers::pi * (3.0 - std::sqrt(5.0));  // golden angle: even over the sphere
    const double radius = std::sqrt(1.0 - z * z);
    const glm::dvec3 view(radius * std::cos(azimuth), radius * std::sin(azimuth), z);
    const Reach ray = reach(radius_m, z);
    const double cos_theta = view.x * sun.x + view.z * sun.z;
    const double molecular = molecular_phase(cos_theta);
    const double aerosol = aerosol_phase(cos_theta);
    Bands through;
    through.fill(1.0);
    for (int step = 0; step <= kSteps; ++step) {
      const bool ground = step == kSteps;
      if (ground && !ray.hits_ground) break;
      const double s0 = static_cast<double>(step) / kSteps;
      const double s1 = static_cast<double>(step + 1) / kSteps;
      const double t = ground ? ray.length_m : 0.5 * ray.length_m * (s0 * s0 + s1 * s1);
      const double length = ray.length_m * (s1 * s1 - s0 * s0);
      const double here = std::sqrt(radius_m * radius_m + t * t + 2.0 * radius_m * z * t);
      const double sun_mu = (radius_m * mu + t * cos_theta) / here;
      const Bands sunlit = sunlight(here, sun_mu);
      if (ground) {
        for (std::size_t i = 0; i < kBandCount; ++i) {
          light[i] += through[i] * ground_albedo_ / std::numbers::pi * std::max(sun_mu, 0.0) * sunlit[i] / kDirections;
        }
        break;
      }
      const Point at = point(here);
      for (std::size_t i = 0; i < kBandCount; ++i) {
        const double stopped = -std::expm1(-at.extinction[i] * length);
        const double weight = through[i] * stopped / std::max(at.extinction[i], 1e-20) / kDirections;
        light[i] += weight * sunlit[i] * (at.molecular_scattering[i] * molecular + at.aerosol_scattering[i] * aerosol);
        returned[i] += weight * (at.molecular_scattering[i] + at.aerosol_scattering[i]);
        through[i] *= 1.0 - stopped;
      }
    }
  }
  for (std::size_t i = 0; i < kBandCount; ++i) light[i] /= 1.0 - returned[i];
  return light;
}

void Atmosphere::tabulate_multiple_scattering() {
  multiple_.resize(static_cast<std::size_t>(kMultipleRadii) * kMultipleAngles);
  for (int row = 0; row < kMultipleRadii; ++row) {
    const double s = static_cast<double>(row) / (kMultipleRadii - 1);
    const double radius = kGroundRadiusM + 10.0 + (kTopRadiusM - kGroundRadiusM - 20.0) * s * s;
    for (int column = 0; column < kMultipleAngles; ++column) {
      multiple_[cell_index(row, column, kMultipleAngles)] = scatter_twice(radius, mu_at(column));
    }
  }
}

Bands Atmosphere::multiple_scattering(double radius_m, double mu) const {
  const double height = std::clamp((radius_m - kGroundRadiusM) / (kTopRadiusM - kGroundRadiusM), 0.0, 1.0);
  const Cell row = cell(std::sqrt(height) * (kMultipleRadii - 1), kMultipleRadii);
  const Cell column = cell(angle_position(mu), kMultipleAngles);
  Bands result{};
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const double weight = (i ? row.weight : 1.0 - row.weight) * (j ? column.weight : 1.0 - column.weight);
      const Bands& at = multiple_[cell_index(row.low + i, column.low + j, kMultipleAngles)];
      for (std::size_t band = 0; band < kBandCount; ++band) result[band] += weight * at[band];
    }
  }
  return result;
}

}  // namespace render
