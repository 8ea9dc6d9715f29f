#include "render/plan/scene_needs.h"

#include <algorithm>

#include "render/shadow/shadow_fit.h"

namespace render {
namespace {

bool can_shadow_medium(const SceneState& scene, const std::vector<const Instance*>& occluders) {
  const std::optional<Box>& extent = scene.medium->extent;
  return std::ranges::any_of(
      occluders, [&](const Instance* occluder) { return !extent || can_shadow(*occluder, *extent, sun_of(scene)); });
}

std::string why_nothing_is_drawn(const SceneState& scene, const SceneNeeds& needs) {
  if (!scene.draw_virtual) return "the camera's pose is not known";
  if (needs.objects || needs.medium) return "";
  return needs.real_instances > 0 ? "nothing virtual casts a shadow on the real things, and there is no medium"
                                  : "the scene has no objects and no medium";
}

std::string why_no_shafts(const SceneState& scene, const SceneNeeds& needs) {
  if (needs.shafts) return "";
  if (!scene.medium) return "the scene has no medium";
  if (!needs.medium) return "the medium's extinction is zero";
  if (!needs.sun) return "no sunlight that occluders could carve shafts into";
  return needs.occluders ? "what casts shadows does not shade the medium" : "nothing in the scene casts a shadow";
}

}  // namespace

SceneNeeds needs_of(const SceneState& scene) {
  SceneNeeds needs;
  for (const Instance& instance : scene.instances) ++(instance.real ? needs.real_instances : needs.virtual_instances);
  const glm::dvec3& sun_rgb = sun_of(scene).illuminance_rgb;
  needs.sun = std::max({sun_rgb.r, sun_rgb.g, sun_rgb.b}) > 0.0;
  const std::vector<const Instance*> virtual_occluders = occluders(scene, Occluders::Virtual);
  const std::vector<const Instance*> real_occluders = occluders(scene, Occluders::Real);
  needs.occluders = !virtual_occluders.empty() || !real_occluders.empty();
  needs.medium = scene.medium && scene.medium->extinction_per_m > 0.0;
  needs.objects = needs.virtual_instances > 0 || (needs.real_instances > 0 && needs.medium);
  needs.shafts = needs.medium && needs.sun &&
                 (can_shadow_medium(scene, virtual_occluders) || can_shadow_medium(scene, real_occluders));
  needs.translucent = needs.shafts && !translucent_occluders(scene).empty();
  needs.nothing_drawn = why_nothing_is_drawn(scene, needs);
  needs.no_shafts = why_no_shafts(scene, needs);
  return needs;
}

}  // namespace render
