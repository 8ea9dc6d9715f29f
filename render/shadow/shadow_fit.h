#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "render/scene/scene_state.h"
#include "render/scene/view.h"

namespace render {

// Where a shadow map looks: an orthographic picture along the sun's rays. Map coordinates are (u, v, depth), each 0 to
// 1 inside the map; depth grows along the light's travel.
struct ShadowFit {
  glm::dmat4 map_from_world{1.0};
  glm::dvec3 metres_per_unit{1.0};  // size of the map along u, v and depth
  bool empty = true;                // no occluders: everything is lit
  bool cut = false;                 // occluders were too large and are cut to what is in view: depends on the view

  bool operator==(const ShadowFit&) const = default;
};

// Which instances cast: virtual things, or those real ones that can shadow anything that is seen.
enum class Occluders { Virtual, Real };
inline constexpr std::array<Occluders, 2> kOccluderKinds{Occluders::Virtual, Occluders::Real};
std::vector<const Instance*> occluders(const SceneState& scene, Occluders kind);

// Whether an instance may hold up light of the sun's disc on its way into that box. Judged by their bounding boxes: yes
// may be wrong, no never is.
bool can_shadow(const Instance& occluder, const Box& box, const Sun& sun);

// Axes of light space as columns, in the world: two across the light, the third along its travel. The first is turned
// from the level by the angle whose tangent is the golden section: texels in line with a wall's or a mast's edges would
// put all of an edge to the same wrong side; along a turned edge, and most evenly along one turned by that, their
// errors cancel.
glm::dmat3 world_from_light(const glm::dvec3& sun_direction_in_world);

// Whether a mesh is of blended material, which tints light where other occluders hold it up.
bool is_translucent(const Model& model, const Mesh& mesh);
// The instances that have such meshes, virtual and real.
std::vector<const Instance*> translucent_occluders(const SceneState& scene);

// What a map is fitted to: occluders as wholes, or their glass alone.
enum class FitTo { Occluders, Translucent };

// The convex pieces of those occluders of whose shadow the eye sees nothing, such as the ground it stands on. What such
// a piece shadows is the convex hull of the piece and of the point at infinity that the light travels to. Where the
// eye's ray to that point meets the piece, the hull's outline, as the eye sees it, is the piece's own: all of it lies
// behind.
struct OccluderPiece {
  std::size_t occluder = 0;  // index into the occluders
  std::size_t piece = 0;     // and into its model's convex pieces
  bool operator==(const OccluderPiece&) const = default;
};
std::vector<OccluderPiece> pieces_before_their_shadow(const std::vector<const Instance*>& occluders,
                                                      const glm::dvec3& sun_direction_in_world,
                                                      const glm::dvec3& eye_in_world);

// The map of `size_px` squared texels around those occluders, a little larger than they are and snapped to its own
// texels, counted from a place that moves with the scene. Occluders above `kWholeM` metres across are cut to what the
// view and the other things can make use of. `left_out` pieces may lie beside the map.
ShadowFit fit_shadow(const SceneState& scene, const View& view, const std::vector<const Instance*>& occluders,
                     int size_px, FitTo to = FitTo::Occluders, const std::vector<OccluderPiece>& left_out = {});

}  // namespace render
