#pragma once

#include <GLES3/gl31.h>

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "render/plan/scene_state.h"
#include "render/scene/gpu_model.h"

namespace render {

// Where a shadow map looks: an orthographic picture along the sun's rays. Map coordinates are (u, v, depth), each 0 to
// 1 inside the map; depth grows along the light's travel.
struct ShadowFit {
  glm::dmat4 map_from_world{1.0};
  glm::dvec3 metres_per_unit{1.0};  // size of the map along u, v and depth
  bool empty = true;                // no casters: everything is lit
};

// Which instances cast: virtual things, or the real ones that can shade anything at all (a real plane with everything
// else on its sunny side cannot).
enum class Casters { Virtual, Real };
std::vector<const Instance*> casters(const SceneState& scene, Casters kind);

// The smallest map of `size_px` squared texels around those casters, snapped to its own texels from an anchor that
// moves with the scene. Casters too large for that are cut to what the camera and the other things can make use of.
ShadowFit fit_shadow(const SceneState& scene, const std::vector<const Instance*>& casters, int size_px);

// A depth map (DEPTH_COMPONENT32F, compare mode LEQUAL, linear filter) and where it looks.
struct ShadowMap {
  GLuint depth_texture = 0;
  int size_px = 0;
  ShadowFit fit;
};

// The sun's shadow maps. Call on the context's thread.
class SunShadow {
 public:
  SunShadow();
  ~SunShadow();
  SunShadow(const SunShadow&) = delete;
  SunShadow& operator=(const SunShadow&) = delete;

  // Renders what changed since the last call (sun, casters, their places, map size); nothing otherwise.
  // Returns whether anything was rendered. Leaves framebuffer, viewport, program and depth state changed.
  bool update(const SceneState& scene, int size_px, GpuModels& models);

  const ShadowMap& map(Casters kind) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace render
