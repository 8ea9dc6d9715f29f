#include "render/shadow/shadow_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace render {
namespace {

constexpr double kWholeM = 60.0;       // occluders up to this size are always in the map as a whole
constexpr double kSeenM = 100.0;       // and beyond it, what lies this far ahead of the eye
constexpr double kMarginTexels = 3.0;  // empty texels around the occluders, so that the map's edge is lit

struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  void add(const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  bool empty() const { return low.x > high.x; }
  glm::dvec3 size() const { return high - low; }
};

std::array<glm::dvec3, 8> corners(const glm::dvec3& low, const glm::dvec3& high) {
  std::array<glm::dvec3, 8> out;
  for (std::size_t i = 0; i < 8; ++i) {
    out[i] = {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z};
  }
  return out;
}

Bounds box_in_light(const Instance& instance, const glm::dmat3& light_from_world) {
  Bounds bounds;
  for (const glm::dvec3& corner : corners(instance.model->bounds_min, instance.model->bounds_max)) {
    bounds.add(light_from_world * glm::dvec3(instance.world_from_model * glm::dvec4(corner, 1.0)));
  }
  return bounds;
}

// Tighter than the box where that matters: what the vertices themselves span, but for those of pieces left out.
Bounds vertices_in_light(const Instance& instance, const glm::dmat3& light_from_world, FitTo to,
                         const std::vector<const ConvexPiece*>& left_out) {
  const glm::dmat4 light_from_model = glm::dmat4(light_from_world) * instance.world_from_model;
  Bounds bounds;
  for (std::size_t i = 0; i < instance.model->meshes.size(); ++i) {
    const Mesh& mesh = instance.model->meshes[i];
    if (to == FitTo::Translucent && !is_translucent(*instance.model, mesh)) continue;
    std::vector<char> out(mesh.vertices.size(), 0);
    for (const ConvexPiece* piece : left_out) {
      if (piece->mesh != i) continue;
      for (const std::uint32_t vertex : piece->vertices) out[vertex] = 1;
    }
    for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
      if (out[k] == 0) bounds.add(glm::dvec3(light_from_model * glm::dvec4(mesh.vertices[k].position, 1.0)));
    }
  }
  return bounds;
}

bool large(const Bounds& bounds) {
  return std::max(bounds.size().x, bounds.size().y) > kWholeM;
}

// What light and eye have to do with: the things of ordinary size, a bounded medium, and the near part of the view.
Bounds region_of_interest(const SceneState& scene, const View& view, const glm::dmat3& light_from_world) {
  Bounds region;
  for (const Instance& instance : scene.instances) {
    const Bounds box = box_in_light(instance, light_from_world);
    if (large(box)) continue;
    region.add(box.low);
    region.add(box.high);
  }
  if (scene.medium && scene.medium->extent) {
    for (const glm::dvec3& corner : corners(scene.medium->extent->min_in_world, scene.medium->extent->max_in_world)) {
      region.add(light_from_world * corner);
    }
  }
  const glm::dmat3 ray_from_px = view.local_ray_from_px();
  region.add(light_from_world * view.eye_in_world);
  for (const glm::dvec2 px :
       {glm::dvec2(0, 0), glm::dvec2(view.width, 0), glm::dvec2(0, view.height), glm::dvec2(view.width, view.height)}) {
    region.add(light_from_world * (view.eye_in_world + kSeenM * (ray_from_px * glm::dvec3(px, 1.0))));
  }
  return region;
}

// Sizes and places in coarse steps, so that a moving view seldom needs a new map.
void cut_to(Bounds& bounds, const Bounds& region) {
  for (int axis = 0; axis < 2; ++axis) {
    const double size = std::exp2(std::ceil(std::log2(region.size()[axis])));
    const double step = size / 4.0;
    const double low = std::floor(region.low[axis] / step) * step;
    bounds.low[axis] = std::max(bounds.low[axis], low);
    bounds.high[axis] = std::max(std::min(bounds.high[axis], low + size + step), bounds.low[axis] + 1e-3);
  }
}

// Where texels are counted from: a real thing (they keep still), else the first thing.
glm::dvec3 anchor_in_world(const SceneState& scene) {
  for (const Instance& instance : scene.instances) {
    if (instance.real) return glm::dvec3(instance.world_from_model[3]);
  }
  return scene.instances.empty() ? glm::dvec3(0.0) : glm::dvec3(scene.instances.front().world_from_model[3]);
}

// A flat real thing cannot shade what lies on its sunny side, and hides the rest from an eye on that side.
bool shadows_nothing(const Instance& plane, const SceneState& scene) {
  const glm::dvec3 low = plane.model->bounds_min;
  const glm::dvec3 size = glm::dvec3(plane.model->bounds_max) - low;
  const int axis = size.x < size.y ? (size.x < size.z ? 0 : 2) : (size.y < size.z ? 1 : 2);
  if (size[axis] > 1e-4 * std::max({size.x, size.y, size.z})) return false;
  glm::dvec3 normal_in_model(0.0);
  normal_in_model[axis] = 1.0;
  const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(glm::dmat3(plane.world_from_model)));
  glm::dvec3 normal = glm::normalize(normal_matrix * normal_in_model);
  if (glm::dot(normal, sun_of(scene).direction_in_world) < 0.0) normal = -normal;
  const glm::dvec3 on_plane(plane.world_from_model * glm::dvec4(low, 1.0));
  const auto sunny = [&](const glm::dvec3& p) { return glm::dot(normal, p - on_plane) >= 0.0; };
  if (!sunny(glm::dvec3(scene.camera.world_from_camera[3]))) return false;
  return std::ranges::all_of(scene.instances, [&](const Instance& other) {
    const glm::dvec3 middle = 0.5 * (glm::dvec3(other.model->bounds_min) + glm::dvec3(other.model->bounds_max));
    return &other == &plane || sunny(glm::dvec3(other.world_from_model * glm::dvec4(middle, 1.0)));
  });
}

}  // namespace

std::vector<const Instance*> occluders(const SceneState& scene, Occluders kind) {
  std::vector<const Instance*> out;
  for (const Instance& instance : scene.instances) {
    if (instance.real != (kind == Occluders::Real)) continue;
    if (instance.real && shadows_nothing(instance, scene)) continue;
    out.push_back(&instance);
  }
  return out;
}

bool is_translucent(const Model& model, const Mesh& mesh) {
  return model.materials[static_cast<std::size_t>(mesh.material)].alpha_mode == AlphaMode::Blend;
}

std::vector<const Instance*> translucent_occluders(const SceneState& scene) {
  std::vector<const Instance*> out;
  for (const Instance& instance : scene.instances) {
    const Model& model = *instance.model;
    if (std::ranges::any_of(model.meshes, [&](const Mesh& mesh) { return is_translucent(model, mesh); })) {
      out.push_back(&instance);
    }
  }
  return out;
}

glm::dmat3 world_from_light(const glm::dvec3& sun_direction_in_world) {
  const glm::dvec3 travel = -glm::normalize(sun_direction_in_world);
  const glm::dvec3 level = glm::cross(glm::dvec3(0.0, 0.0, 1.0), travel);
  const double length = glm::length(level);
  const glm::dvec3 across = length > 1e-9 ? level / length : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 up = glm::cross(travel, across);
  constexpr double kCosine = 0.85065080835203993;  // of the angle with the tangent 0.618..., the golden section
  constexpr double kSine = 0.52573111211913361;
  return {kCosine * across + kSine * up, kCosine * up - kSine * across, travel};
}

bool can_shadow(const Instance& occluder, const Box& box, const Sun& sun) {
  const Bounds held = box_in_light(occluder, glm::dmat3(1.0));  // in the world's axes
  // Light that leaves a point c of the occluder is in the box after a way t where c + t * travel is: where the ray t *
  // travel meets the box of all differences. The sun's disc spreads it to the sides.
  const double farthest_m = glm::length(glm::max(glm::abs(box.max_in_world - held.low),  //
                                                 glm::abs(held.high - box.min_in_world)));
  const double spread_m = farthest_m * std::tan(sun.angular_radius_rad);
  const glm::dvec3 low = box.min_in_world - held.high - spread_m;
  const glm::dvec3 high = box.max_in_world - held.low + spread_m;
  double enter_m = 0.0;
  double leave_m = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double travel = -sun.direction_in_world[axis];
    if (travel == 0.0) {
      if (low[axis] > 0.0 || high[axis] < 0.0) return false;
      continue;
    }
    const double a = low[axis] / travel;
    const double b = high[axis] / travel;
    enter_m = std::max(enter_m, std::min(a, b));
    leave_m = std::min(leave_m, std::max(a, b));
  }
  return enter_m <= leave_m;
}

std::vector<OccluderPiece> pieces_before_their_shadow(const std::vector<const Instance*>& occluders,
                                                      const glm::dvec3& sun_direction_in_world,
                                                      const glm::dvec3& eye_in_world) {
  std::vector<OccluderPiece> out;
  for (std::size_t i = 0; i < occluders.size(); ++i) {
    const std::vector<ConvexPiece>& pieces = occluders[i]->model->convex_pieces;
    if (pieces.empty()) continue;
    const glm::dmat4 model_from_world = glm::inverse(occluders[i]->world_from_model);
    const glm::dvec3 eye(model_from_world * glm::dvec4(eye_in_world, 1.0));
    const glm::dvec3 travel(model_from_world * glm::dvec4(-sun_direction_in_world, 0.0));
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      if (meets(pieces[k], eye, travel)) out.push_back({i, k});
    }
  }
  return out;
}

ShadowFit fit_shadow(const SceneState& scene, const View& view, const std::vector<const Instance*>& occluders,
                     int size_px, FitTo to, const std::vector<OccluderPiece>& left_out) {
  ShadowFit fit;
  if (occluders.empty()) return fit;
  const glm::dmat3 light_from_world = glm::transpose(world_from_light(sun_of(scene).direction_in_world));
  const Bounds region = region_of_interest(scene, view, light_from_world);
  Bounds all;
  for (std::size_t i = 0; i < occluders.size(); ++i) {
    const Instance& occluder = *occluders[i];
    std::vector<const ConvexPiece*> without;
    for (const OccluderPiece& out : left_out) {
      if (out.occluder == i) without.push_back(&occluder.model->convex_pieces[out.piece]);
    }
    const bool by_vertices = to == FitTo::Translucent || !without.empty();
    Bounds bounds = by_vertices ? vertices_in_light(occluder, light_from_world, to, without)
                                : box_in_light(occluder, light_from_world);
    if (bounds.empty()) continue;
    if (large(bounds)) {
      cut_to(bounds, region);
      fit.cut = true;
    } else if (!by_vertices) {
      bounds = vertices_in_light(occluder, light_from_world, to, without);
    }
    all.add(bounds.low);
    all.add(bounds.high);
  }
  if (all.empty()) return fit;

  const glm::dvec3 anchor = light_from_world * anchor_in_world(scene);
  glm::dvec3 size(0.0, 0.0, all.size().z + 0.02);
  glm::dvec3 low(0.0, 0.0, all.low.z - 0.01);
  for (int axis = 0; axis < 2; ++axis) {
    // Sizes in steps of 1/8 octave, so that moving occluders seldom change the texel.
    const double within_px = std::max(size_px - 2.0 * kMarginTexels - 1.0, 0.5 * size_px);  // of a tiny map, half
    const double needed = std::max(all.size()[axis], 1e-3) * size_px / within_px;
    size[axis] = std::exp2(std::ceil(8.0 * std::log2(needed)) / 8.0);
    const double texel = size[axis] / size_px;
    const double middle = 0.5 * (all.low[axis] + all.high[axis]) - 0.5 * size[axis] - anchor[axis];
    low[axis] = anchor[axis] + std::round(middle / texel) * texel;
  }
  fit.map_from_world =
      glm::scale(glm::dmat4(1.0), 1.0 / size) * glm::translate(glm::dmat4(1.0), -low) * glm::dmat4(light_from_world);
  fit.metres_per_unit = size;
  fit.empty = false;
  return fit;
}

}  // namespace render
