#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/sky/spherical_triangle.h"
#include "render/sky/tessellation.h"

namespace render {
namespace {

glm::dvec3 grid_point(int row, int rows, int sector, int sectors) {
  const double elevation = 0.5 * std::numbers::pi * row / rows;
  const double azimuth = 2.0 * std::numbers::pi * sector / sectors;
  if (row == rows) return {0.0, 0.0, 1.0};
  return {std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth), std::sin(elevation)};
}

// The triangles of one cell: two, or one at the zenith.
std::vector<SphericalTriangle> cell_triangles(int row, int rows, int sector, int sectors) {
  const glm::dvec3 lower = grid_point(row, rows, sector, sectors);
  const glm::dvec3 lower_next = grid_point(row, rows, sector + 1, sectors);
  const glm::dvec3 upper = grid_point(row + 1, rows, sector, sectors);
  const glm::dvec3 upper_next = grid_point(row + 1, rows, sector + 1, sectors);
  // azimuth runs clockwise seen from above, so counter-clockwise from outside is next before this
  if (row + 1 == rows) return {{{lower_next, lower, upper}}};
  return {{{lower_next, lower, upper}}, {{lower_next, upper, upper_next}}};
}

void sample(const SkyModel& sky, const SkyVisibility& visibility, const SphericalTriangle& triangle, int depth,
            SkyPatch& patch) {
  if (depth > 0) {
    for (const SphericalTriangle& quarter : triangle.quarters()) sample(sky, visibility, quarter, depth - 1, patch);
    return;
  }
  const double solid_angle = triangle.solid_angle_sr();
  const glm::dvec3 middle = triangle.centroid();
  patch.solid_angle_sr += solid_angle;
  patch.moment_sr += triangle.moment_sr();
  // Means are weighted by projected solid angle, so that coarse patches keep the illuminance of level ground.
  const double weight = triangle.moment_sr().z;
  patch.luminance_rgb += sky.luminance_rgb(middle) * weight;
  patch.visibility += (visibility.seen ? visibility.seen(middle) : 1.0) * weight;
}

SkyPatch patch_of(const SkyModel& sky, const SkyVisibility& visibility, const std::vector<SphericalTriangle>& triangles,
                  int depth) {
  SkyPatch patch{glm::dvec3(0.0), 0.0, glm::dvec3(0.0), glm::dvec3(0.0), 0.0};
  for (const SphericalTriangle& triangle : triangles) sample(sky, visibility, triangle, depth, patch);
  patch.direction_in_world = glm::normalize(patch.moment_sr);
  patch.luminance_rgb /= patch.moment_sr.z;
  patch.visibility /= patch.moment_sr.z;
  return patch;
}

}  // namespace

std::vector<SkyPatch> dome5728(const SkyModel& sky, const SkyVisibility& visibility) {
  constexpr int kRows = 90;
  constexpr int kSectors = 32;
  std::vector<SkyPatch> patches;
  for (int row = 0; row < kRows; ++row) {
    for (int sector = 0; sector < kSectors; ++sector) {
      for (const SphericalTriangle& triangle : cell_triangles(row, kRows, sector, kSectors)) {
        patches.push_back(patch_of(sky, visibility, {triangle}, 0));
      }
    }
  }
  return patches;
}

std::vector<SkyPatch> dome144(const SkyModel& sky, const SkyVisibility& visibility) {
  constexpr int kRows = 6;
  constexpr int kSectors = 24;
  constexpr int kSampleDepth = 2;  // 32 samples a patch: one would miss the brightness around the sun
  std::vector<SkyPatch> patches;
  for (int row = 0; row < kRows; ++row) {
    for (int sector = 0; sector < kSectors; ++sector) {
      patches.push_back(patch_of(sky, visibility, cell_triangles(row, kRows, sector, kSectors), kSampleDepth));
    }
  }
  return patches;
}

}  // namespace render
