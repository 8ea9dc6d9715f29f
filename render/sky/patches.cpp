#include "render/sky/patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

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

namespace {

// Whether a ray from `eye` passes through the portal: eye + t direction = corner + u edge_u + v edge_v, Cramer's rule.
bool passes(const Portal& portal, const glm::dvec3& eye, const glm::dvec3& direction) {
  const glm::dvec3 normal = glm::cross(portal.edge_u, portal.edge_v);
  const double facing = glm::dot(direction, normal);
  if (std::abs(facing) < 1e-12) return false;
  const double t = glm::dot(portal.corner_in_world - eye, normal) / facing;
  if (t <= 0.0) return false;
  const glm::dvec3 in_plane = eye + t * direction - portal.corner_in_world;
  const double area = glm::dot(normal, normal);
  const double u = glm::dot(glm::cross(in_plane, portal.edge_v), normal) / area;
  const double v = glm::dot(glm::cross(portal.edge_u, in_plane), normal) / area;
  return u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0;
}

// Angle from a unit direction to the great-circle arc between two others.
double angle_to_arc(const glm::dvec3& direction, const glm::dvec3& from, const glm::dvec3& to) {
  const double ends = std::acos(std::clamp(std::max(glm::dot(direction, from), glm::dot(direction, to)), -1.0, 1.0));
  const glm::dvec3 across = glm::cross(from, to);
  if (glm::length(across) < 1e-12) return ends;
  const glm::dvec3 normal = glm::normalize(across);
  const glm::dvec3 foot = direction - normal * glm::dot(direction, normal);
  const bool beside = glm::dot(glm::cross(from, foot), normal) >= 0.0 && glm::dot(glm::cross(foot, to), normal) >= 0.0;
  return beside ? std::asin(std::clamp(std::abs(glm::dot(direction, normal)), 0.0, 1.0)) : ends;
}

double angle_to_outline(const Portal& portal, const glm::dvec3& eye, const glm::dvec3& direction) {
  const glm::dvec3 corner = portal.corner_in_world - eye;
  const std::array<glm::dvec3, 4> outline = {glm::normalize(corner), glm::normalize(corner + portal.edge_u),
                                             glm::normalize(corner + portal.edge_u + portal.edge_v),
                                             glm::normalize(corner + portal.edge_v)};
  double nearest = std::numbers::pi;
  for (std::size_t i = 0; i < 4; ++i) {
    nearest = std::min(nearest, angle_to_arc(direction, outline[i], outline[(i + 1) % 4]));
  }
  return nearest;
}

}  // namespace

SkyVisibility through_portals(const std::vector<Portal>& portals, const glm::dvec3& eye_in_world) {
  SkyVisibility visibility;
  visibility.seen = [portals, eye_in_world](const glm::dvec3& direction) {
    const auto open = [&](const Portal& portal) { return passes(portal, eye_in_world, direction); };
    return std::any_of(portals.begin(), portals.end(), open) ? 1.0 : 0.0;
  };
  visibility.edge_distance_rad = [portals, eye_in_world](const glm::dvec3& direction) {
    double nearest = std::numbers::pi;
    for (const Portal& portal : portals) nearest = std::min(nearest, angle_to_outline(portal, eye_in_world, direction));
    return nearest;
  };
  return visibility;
}

}  // namespace render
