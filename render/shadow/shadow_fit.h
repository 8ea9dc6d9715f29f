#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "render/plan/scene_state.h"
#include "render/scene/view.h"

namespace render {

// Where a shadow map looks: an orthographic picture along the sun's rays. Map coordinates are (u, v, depth), each 0 to
// 1 inside the map; depth grows along the light's travel.
struct ShadowFit {
  glm::dmat4 map_from_world{1.0};
  glm::dvec3 metres_per_unit{1.0};  // size of the map along u, v and depth
  bool empty = true;                // no casters: everything is lit
  bool cut = false;                 // casters were too large and are cut to what is in view: depends on the view

  bool operator==(const ShadowFit&) const = default;
};

// Which instances cast: virtual things, or those real ones that can shade anything that is seen.
enum class Casters { Virtual, Real };
std::vector<const Instance*> casters(const SceneState& scene, Casters kind);

// Whether an instance may hold up light of the sun's disc on its way into that box. Judged by their bounding boxes: yes
// may be wrong, no never is.
bool can_shade(const Instance& caster, const Box& box, const Sun& sun);

// Axes of light space as columns, in the world: two across the light, the third along its travel. The first is level.
glm::dmat3 world_from_light(const glm::dvec3& sun_direction_in_world);

// Whether a mesh is of blended material, which tints light where other casters hold it up.
bool is_glass(const Model& model, const Mesh& mesh);
// The instances that have such meshes, virtual and real.
std::vector<const Instance*> glass_casters(const SceneState& scene);

// What a map is fitted to: casters as wholes, or their glass alone.
enum class FitTo { Casters, Glass };

// The map of `size_px` squared texels around those casters, a little larger than they are and snapped to its own
// texels, counted from a place that moves with the scene. Casters above `kWholeM` metres across are cut to what the
// view and the other things can make use of.
ShadowFit fit_shadow(const SceneState& scene, const View& view, const std::vector<const Instance*>& casters,
                     int size_px, FitTo to = FitTo::Casters);

}  // namespace render
