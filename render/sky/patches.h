#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "render/sky/sky_light.h"
#include "render/sky/sky_model.h"

namespace render {

// A piece of the sky.
struct SkyPatch {
  glm::dvec3 direction_in_world;  // its middle
  double solid_angle_sr;
  glm::dvec3 moment_sr;      // integral of the direction over the patch: dot it with a normal for projected solid angle
  glm::dvec3 luminance_rgb;  // mean, cd/m2
  double visibility;         // share that is seen, [0, 1]
};

// What a portal or an obstacle leaves of the sky. Empty functions: all of it.
struct SkyVisibility {
  std::function<double(const glm::dvec3& direction_in_world)> seen;  // share, [0, 1]
  // Angle in radians to the nearest direction at which `seen` jumps, or less. Without it thin things may be missed.
  std::function<double(const glm::dvec3& direction_in_world)> edge_distance_rad;
};

// The upper half of the sky in patches that tile it exactly: their solid angles sum to 2 pi.
class SkyPatches {
 public:
  explicit SkyPatches(std::vector<SkyPatch> patches) : patches_(std::move(patches)) {}

  const std::vector<SkyPatch>& patches() const { return patches_; }

  // Lux of a plane with that unit normal from the visible patches. Patches that the plane cuts count by the part of
  // their moment in front of it.
  glm::dvec3 illuminance_rgb(const glm::dvec3& normal_in_world) const;

  // Spherical harmonics of the visible patches' luminance; nothing below the horizon.
  Sh9 radiance_sh() const;

 private:
  std::vector<SkyPatch> patches_;
};

struct PatchOptions {
  // dome5728: 90 rows of 1 degree by 32 sectors, the light-shaft paper's triangles. dome144: 15 degree steps (Yang
  // 2007). geodesic: the upper half of an icosahedron, refined where it matters.
  std::string tessellation = "geodesic";
  double max_error = 0.005;    // geodesic: estimated error of the horizontal illuminance, relative
  int max_patches = 20000;     // geodesic: never more than that
  SkyVisibility visibility{};  // empty: everything is seen
};

// Throws std::runtime_error that names an unknown tessellation and lists the known ones.
SkyPatches make_patches(const SkyModel& sky, const PatchOptions& options);

// Windows of an indoor scene: parallelograms with one corner and two edges in the world, metres.
struct Portal {
  glm::dvec3 corner_in_world;
  glm::dvec3 edge_u;
  glm::dvec3 edge_v;
};

// What of the sky is seen through any of `portals` from a point; nothing where there are none.
SkyVisibility through_portals(const std::vector<Portal>& portals, const glm::dvec3& eye_in_world);

}  // namespace render
