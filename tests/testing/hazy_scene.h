#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "render/scene/mesh_tools.h"
#include "render/shafts/reference/shaft_reference.h"

// Plates in haze under a sun in the east, for tests of the reference whose answer is a closed form.
namespace render {

inline constexpr double kEndless = std::numeric_limits<double>::infinity();
inline constexpr double kPi = std::numbers::pi;
inline const glm::dvec3 kLux(90000.0, 80000.0, 70000.0);

// Horizontal rectangle at that height, as two triangles.
inline void add_plate(Mesh& mesh, const glm::vec2& low, const glm::vec2& high, float z) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const glm::vec3 up(0.0F, 0.0F, 1.0F);
  const glm::vec4 east(1.0F, 0.0F, 0.0F, 1.0F);
  mesh.vertices.push_back({{low.x, low.y, z}, up, east, {0.0F, 1.0F}});
  mesh.vertices.push_back({{high.x, low.y, z}, up, east, {1.0F, 1.0F}});
  mesh.vertices.push_back({{high.x, high.y, z}, up, east, {1.0F, 0.0F}});
  mesh.vertices.push_back({{low.x, high.y, z}, up, east, {0.0F, 0.0F}});
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + i);
}

inline Model model_of(Mesh mesh, const Material& material = {}) {
  Model model;
  model.meshes.push_back(std::move(mesh));
  model.materials.push_back(material);
  update_bounds(model);
  return model;
}

inline Instance place(Model model, const glm::dvec3& at = glm::dvec3(0.0)) {
  return {.name = "",
          .model = std::make_shared<const Model>(std::move(model)),
          .world_from_model = place_model(at, 0.0, 1.0)};
}

// Sun in the east, 45 degrees high, in a medium without bounds; no sky.
inline SceneState hazy(double extinction_per_m) {
  SceneState scene;
  ensure_sun(scene) = {.direction_in_world = {std::sqrt(0.5), 0.0, std::sqrt(0.5)}, .illuminance_rgb = kLux};
  scene.medium = Medium{.extinction_per_m = extinction_per_m, .albedo = 0.9, .g = 0.4};
  return scene;
}

inline glm::dvec3 sun_scale(const SceneState& scene, const ViewRay& ray) {
  return kLux * (scene.medium->albedo * phase(scene.medium->phase_function, scene.medium->g,
                                              glm::dot(ray.direction_in_world, sun_of(scene).direction_in_world)));
}

// As closed forms are held to.
inline void expect_same(const glm::dvec3& found, const glm::dvec3& expected, double relative = 1e-6) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i] / expected[i], 1.0, relative) << found[i] << " for " << expected[i];
}

inline const ViewRay kEastward{{0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}};

}  // namespace render
