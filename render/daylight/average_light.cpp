#include "render/daylight/average_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/daylight/daylight.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

constexpr double kSampleDeg = 3.75;

// Directions sampled in every bin, `side` by `side`, evenly in azimuth and in the sine of the elevation.
class Grid {
 public:
  explicit Grid(double bin_deg)
      : rows_(static_cast<int>(std::lround(90.0 / bin_deg))),
        sectors_(4 * rows_),
        side_(std::max(1, static_cast<int>(std::ceil(bin_deg / kSampleDeg)))) {}

  std::vector<DirectionBin> empty_bins() const {
    std::vector<DirectionBin> bins;
    for (int row = 0; row < rows_; ++row) {
      for (int sector = 0; sector < sectors_; ++sector) {
        DirectionBin& bin = bins.emplace_back();
        bin.azimuth_rad = 2.0 * std::numbers::pi * (sector + 0.5) / sectors_;
        bin.elevation_rad = 0.5 * std::numbers::pi * (row + 0.5) / rows_;
        bin.solid_angle_sr = sample_sr(row) * side_ * side_;
      }
    }
    return bins;
  }

  // Calls visit(index of the bin, direction, solid angle) for every sample.
  template <typename Visit>
  void for_each_sample(const Visit& visit) const {
    for (int row = 0; row < rows_; ++row) {
      for (int sector = 0; sector < sectors_; ++sector) {
        for (int j = 0; j < side_; ++j) {
          for (int i = 0; i < side_; ++i) visit(index(row, sector), sample(row, sector, i, j), sample_sr(row));
        }
      }
    }
  }

  std::size_t bin_of(double azimuth_rad, double elevation_rad) const {
    const double turns = azimuth_rad / (2.0 * std::numbers::pi);
    const int sector = std::min(static_cast<int>((turns - std::floor(turns)) * sectors_), sectors_ - 1);
    const int row = std::clamp(static_cast<int>(elevation_rad / (0.5 * std::numbers::pi) * rows_), 0, rows_ - 1);
    return index(row, sector);
  }

 private:
  std::size_t index(int row, int sector) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(sectors_) + static_cast<std::size_t>(sector);
  }
  double sine(double row) const { return std::sin(0.5 * std::numbers::pi * row / rows_); }
  double sample_sr(int row) const {
    return (sine(row + 1) - sine(row)) * 2.0 * std::numbers::pi / sectors_ / (static_cast<double>(side_) * side_);
  }
  glm::dvec3 sample(int row, int sector, int i, int j) const {
    const double azimuth = 2.0 * std::numbers::pi * (sector + (i + 0.5) / side_) / sectors_;
    const double z = sine(row) + (sine(row + 1) - sine(row)) * (j + 0.5) / side_;
    const double radius = std::sqrt(std::max(1.0 - z * z, 0.0));
    return {radius * std::sin(azimuth), radius * std::cos(azimuth), z};
  }

  int rows_;
  int sectors_;
  int side_;
};

// Adds what sky and sun of one instant give, `weight` of the whole time.
void add_instant(AverageLight& light, const Grid& grid, const Daylight& now, double weight) {
  const glm::dvec3 normal = light.request.plane.normal_in_world();
  grid.for_each_sample([&](std::size_t index, const glm::dvec3& direction, double solid_angle_sr) {
    const glm::dvec3 rgb = now.sky->luminance_rgb(direction) * (weight * solid_angle_sr);
    const glm::dvec3 on_plane = rgb * std::max(glm::dot(direction, normal), 0.0);
    DirectionBin& bin = light.bins[index];
    bin.sky_luminance_rgb += rgb / bin.solid_angle_sr;
    bin.plane_sky_lux += luminance(on_plane);
    light.sky_illuminance_rgb += on_plane;
  });
  const glm::dvec3 sun = now.sun_illuminance_rgb * weight;
  const glm::dvec3 on_plane = sun * std::max(glm::dot(now.sun.apparent_direction_in_world(), normal), 0.0);
  DirectionBin& bin = light.bins[grid.bin_of(now.sun.azimuth_rad, now.sun.apparent_elevation_rad)];
  bin.sun_illuminance_rgb += sun;
  bin.plane_sun_lux += luminance(on_plane);
  light.sun_illuminance_rgb += on_plane;
}

void note_new(const std::vector<std::string>& messages, std::vector<std::string>& noted) {
  for (const std::string& message : messages) {
    if (std::find(noted.begin(), noted.end(), message) == noted.end()) noted.push_back(message);
  }
}

}  // namespace

glm::dvec3 LitPlane::normal_in_world() const {
  return {std::sin(azimuth_rad) * std::sin(tilt_rad), std::cos(azimuth_rad) * std::sin(tilt_rad), std::cos(tilt_rad)};
}

AverageLight average_light(const AverageRequest& request) {
  using Hours = std::chrono::duration<double, std::ratio<3600>>;
  const Grid grid(request.bin_deg);
  AverageLight light;
  light.request = request;
  light.bins = grid.empty_bins();
  const auto steps = (request.last - request.first) / request.step;
  light.instants = static_cast<int>(steps) + 1;
  light.hours = Hours(steps * request.step).count();
  DaylightRequest now;
  now.place = request.place;
  now.tier = request.tier;
  now.weather = request.weather;
  now.sky = request.sky;
  for (int i = 0; i < light.instants; ++i) {
    now.time = request.first + i * request.step;
    const bool end = i == 0 || i == light.instants - 1;
    const double weight = steps == 0 ? 1.0 : (end ? 0.5 : 1.0) / static_cast<double>(steps);
    const Daylight instant = daylight(now);
    note_new(beyond_range(instant), light.beyond_range);
    add_instant(light, grid, instant, weight);
  }
  return light;
}

}  // namespace render
