#include "render/sky/reference_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "render/sky/atmosphere.h"
#include "render/sky/direction.h"
#include "render/sky/sky_model_list.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

struct Detail {
  int rows;     // elevation, dense at the horizon
  int columns;  // azimuth from the sun, 0 to 180 degrees
  int steps;    // along each ray
};
constexpr Detail kFull{36, 19, 32};
constexpr Detail kColors{20, 11, 24};
constexpr double kEyeRadiusM = Atmosphere::kGroundRadiusM + 2.0;

// What arrives from one direction, in XYZ: light scattered once by molecules and by aerosol, still to be multiplied by
// their phase functions, and light scattered more often. All three change slowly over the sky; the phase functions
// do not.
struct Arriving {
  glm::dvec3 molecular{0.0};
  glm::dvec3 aerosol{0.0};
  glm::dvec3 multiple{0.0};
};

Arriving mix(const Arriving& a, const Arriving& b, double w) {
  return {a.molecular + (b.molecular - a.molecular) * w, a.aerosol + (b.aerosol - a.aerosol) * w,
          a.multiple + (b.multiple - a.multiple) * w};
}

Arriving integrate(const Atmosphere& air, const glm::dvec3& view, const glm::dvec3& sun, int steps) {
  const double length = Atmosphere::reach(kEyeRadiusM, view.z).length_m;
  const double cos_theta = glm::dot(view, sun);
  Bands molecular{};
  Bands aerosol{};
  Bands multiple{};
  Bands through;
  through.fill(1.0);
  for (int step = 0; step < steps; ++step) {
    const double s0 = static_cast<double>(step) / steps;
    const double s1 = static_cast<double>(step + 1) / steps;
    const double step_m = length * (s1 * s1 - s0 * s0);
    const double t = 0.5 * length * (s0 * s0 + s1 * s1);
    const double radius = std::sqrt(kEyeRadiusM * kEyeRadiusM + t * t + 2.0 * kEyeRadiusM * view.z * t);
    const double sun_mu = (kEyeRadiusM * sun.z + t * cos_theta) / radius;
    const Atmosphere::Point at = air.point(radius);
    const Bands sunlit = air.sunlight(radius, sun_mu);
    const Bands ambient = air.multiple_scattering(radius, sun_mu);
    for (std::size_t i = 0; i < kBandCount; ++i) {
      const double stopped = -std::expm1(-at.extinction[i] * step_m);
      const double weight = through[i] * stopped / std::max(at.extinction[i], 1e-20);
      molecular[i] += weight * at.molecular_scattering[i] * sunlit[i];
      aerosol[i] += weight * at.aerosol_scattering[i] * sunlit[i];
      multiple[i] += weight * (at.molecular_scattering[i] + at.aerosol_scattering[i]) * ambient[i];
      through[i] *= 1.0 - stopped;
    }
  }
  return {xyz_from_solar_multiples(molecular), xyz_from_solar_multiples(aerosol), xyz_from_solar_multiples(multiple)};
}

class ReferenceSky final : public SkyModel {
 public:
  ReferenceSky(double turbidity, const SunPosition& sun, const Detail& detail)
      : rows_(detail.rows),
        columns_(detail.columns),
        air_(Atmosphere::shared(turbidity)),
        sun_in_world_(sun.direction_in_world()),
        seen_sun_in_world_(sun.apparent_direction_in_world()),
        brightness_(1.0 / (sun.distance_au * sun.distance_au)) {
    const glm::dvec3 from_south(std::cos(sun.elevation_rad), 0.0, sun_in_world_.z);
    table_.resize(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_));
    for (int row = 0; row < rows_; ++row) {
      const double v = static_cast<double>(row) / (rows_ - 1);
      const double elevation = 0.5 * std::numbers::pi * v * v;
      for (int column = 0; column < columns_; ++column) {
        const double azimuth = std::numbers::pi * column / (columns_ - 1);
        const glm::dvec3 view(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                              std::sin(elevation));
        table_[index(row, column)] = integrate(*air_, view, from_south, detail.steps);
      }
    }
  }

  glm::dvec3 luminance_rgb(const glm::dvec3& direction_in_world) const override {
    return clip_to_gamut(rgb_from_xyz(luminance_xyz(direction_in_world)));
  }

  glm::dvec3 luminance_xyz(const glm::dvec3& direction_in_world) const override {
    const glm::dvec3 view = above_horizon(direction_in_world);
    const Arriving light = look_up(view);
    const double cos_theta = angle_between(view, seen_sun_in_world_).cosine;
    const glm::dvec3 xyz = light.molecular * air_->molecular_phase(cos_theta) +
                           light.aerosol * air_->aerosol_phase(cos_theta) + light.multiple;
    return xyz * brightness_;
  }

 private:
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }

  Arriving look_up(const glm::dvec3& view) const {
    const double row = std::sqrt(std::asin(std::min(view.z, 1.0)) / (0.5 * std::numbers::pi)) * (rows_ - 1);
    // With the sun at the zenith the azimuth means nothing and the table is the same in every column.
    const double sine = view.x * sun_in_world_.y - view.y * sun_in_world_.x;
    const double cosine = view.x * sun_in_world_.x + view.y * sun_in_world_.y;
    const double column = std::abs(std::atan2(sine, cosine)) / std::numbers::pi * (columns_ - 1);
    const int r = std::clamp(static_cast<int>(row), 0, rows_ - 2);
    const int c = std::clamp(static_cast<int>(column), 0, columns_ - 2);
    const auto at = [this](int i, int j) -> const Arriving& { return table_[index(i, j)]; };
    return mix(mix(at(r, c), at(r, c + 1), column - c), mix(at(r + 1, c), at(r + 1, c + 1), column - c), row - r);
  }

  int rows_;
  int columns_;
  std::shared_ptr<const Atmosphere> air_;
  glm::dvec3 sun_in_world_;
  glm::dvec3 seen_sun_in_world_;
  double brightness_;
  std::vector<Arriving> table_;
};

}  // namespace

std::unique_ptr<SkyModel> make_reference_sky(double turbidity, const SunPosition& sun) {
  return std::make_unique<ReferenceSky>(turbidity, sun, kFull);
}

std::unique_ptr<SkyModel> make_reference_colors(double turbidity, const SunPosition& sun) {
  return std::make_unique<ReferenceSky>(turbidity, sun, kColors);
}

SkyModelInfo reference_model() {
  return {.written = "reference",
          .words = {"reference"},
          .summary =
              "Our own: single scattering exact, multiple scattering after Hillaire 2020, in a spherical "
              "atmosphere of molecules, aerosol and ozone, eleven wavelengths, over ground of albedo 0.08 (grass "
              "and woods in visible light).",
          .turbidity = TurbidityLimits{1.0, 20.0},
          .quick = false,
          .make = [](const SkyOptions& options, const SunPosition& sun) {
            return make_reference_sky(options.turbidity, sun);
          }};
}

}  // namespace render
