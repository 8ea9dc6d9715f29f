#include "render/sky/patches.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "render/sky/tessellation.h"

namespace render {

glm::dvec3 SkyPatches::illuminance_rgb(const glm::dvec3& normal_in_world) const {
  glm::dvec3 sum(0.0);
  for (const SkyPatch& patch : patches_) {
    sum += patch.luminance_rgb * (patch.visibility * std::max(glm::dot(patch.moment_sr, normal_in_world), 0.0));
  }
  return sum;
}

Sh9 SkyPatches::radiance_sh() const {
  Sh9 sh{};
  for (const SkyPatch& patch : patches_) {
    add_to_sh(sh, patch.direction_in_world, patch.luminance_rgb * patch.visibility, patch.solid_angle_sr);
  }
  return sh;
}

SkyPatches make_patches(const SkyModel& sky, const PatchOptions& options) {
  if (options.tessellation == "dome5728") return SkyPatches(dome5728(sky, options.visibility));
  if (options.tessellation == "dome144") return SkyPatches(dome144(sky, options.visibility));
  if (options.tessellation == "geodesic") return SkyPatches(geodesic(sky, options));
  throw std::runtime_error("unknown tessellation `" + options.tessellation +
                           "`\nknown tessellations: dome5728, dome144, geodesic");
}

SkyVisibility through_portals(std::vector<Portal> portals, const glm::dvec3& eye_in_world) {
  return [portals = std::move(portals), eye_in_world](const glm::dvec3& direction_in_world) {
    for (const Portal& portal : portals) {
      // eye + t direction = corner + u edge_u + v edge_v, by Cramer's rule
      const glm::dvec3 normal = glm::cross(portal.edge_u, portal.edge_v);
      const double facing = glm::dot(direction_in_world, normal);
      if (std::abs(facing) < 1e-12) continue;
      const double t = glm::dot(portal.corner_in_world - eye_in_world, normal) / facing;
      if (t <= 0.0) continue;
      const glm::dvec3 in_plane = eye_in_world + t * direction_in_world - portal.corner_in_world;
      const double area = glm::dot(normal, normal);
      const double u = glm::dot(glm::cross(in_plane, portal.edge_v), normal) / area;
      const double v = glm::dot(glm::cross(portal.edge_u, in_plane), normal) / area;
      if (u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0) return 1.0;
    }
    return 0.0;
  };
}

}  // namespace render
