#include "render/sky/hemisphere.h"

#include <cmath>
#include <numbers>

namespace render {
namespace {

constexpr int kRings = 32;
constexpr int kSectors = 64;

struct GaussNode {
  double z;
  double weight;
};

// Gauss-Legendre node i of n on [0, 1]: Newton's method on P_n from Tricomi's estimate.
GaussNode gauss_legendre(int i, int n) {
  double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
  double slope = 1.0;
  for (int step = 0; step < 8; ++step) {
    double before = 1.0;
    double value = x;
    for (int k = 2; k <= n; ++k) {
      const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
      before = value;
      value = next;
    }
    slope = n * (x * value - before) / (x * x - 1.0);
    x -= value / slope;
  }
  return {0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope)};
}

std::vector<SolidAngleSample> sample_upper_half() {
  std::vector<SolidAngleSample> samples;
  samples.reserve(kRings * kSectors);
  for (int ring = 0; ring < kRings; ++ring) {
    const GaussNode node = gauss_legendre(ring, kRings);
    const double radius = std::sqrt(1.0 - node.z * node.z);
    const double solid_angle = 2.0 * std::numbers::pi * node.weight / kSectors;
    for (int sector = 0; sector < kSectors; ++sector) {
      const double azimuth = 2.0 * std::numbers::pi * (sector + 0.5) / kSectors;
      samples.push_back({{radius * std::sin(azimuth), radius * std::cos(azimuth), node.z}, solid_angle});
    }
  }
  return samples;
}

}  // namespace

const std::vector<SolidAngleSample>& upper_hemisphere() {
  static const std::vector<SolidAngleSample> samples = sample_upper_half();
  return samples;
}

glm::dvec3 horizontal_illuminance(const SkyModel& sky) {
  glm::dvec3 sum(0.0);
  for (const SolidAngleSample& sample : upper_hemisphere()) {
    sum += sky.luminance_rgb(sample.direction_in_world) * (sample.direction_in_world.z * sample.solid_angle_sr);
  }
  return sum;
}

}  // namespace render
