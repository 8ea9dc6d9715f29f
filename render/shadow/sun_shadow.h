#pragma once

#include <GLES3/gl31.h>

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <string_view>
#include <vector>

#include "render/gl/gpu_model.h"
#include "render/gl/program.h"
#include "render/scene/scene_state.h"
#include "render/scene/view.h"
#include "render/shadow/shadow_fit.h"

namespace render {

// A depth map, one layer of an array of them (DEPTH_COMPONENT32F, or 16 for the medium alone), and where it looks.
struct ShadowMap {
  int layer = 0;
  int size_px = 0;
  unsigned revision = 0;  // counts its renderings
  ShadowFit fit;
};

// What tints the light: blended materials, as stained glass. Behind the first of them on the light's way their light is
// what all of them together let through.
struct TranslucentMap {
  int size_px = 0;
  ShadowFit fit;  // empty: there is no glass
};

// The sun's shadow maps. Call on the context's thread.
class SunShadow {
 public:
  SunShadow();
  ~SunShadow();
  SunShadow(const SunShadow&) = delete;
  SunShadow& operator=(const SunShadow&) = delete;

  // Renders what changed since the last call (sun, occluders, their places, map size); nothing otherwise. A sun that
  // has moved its shadows by less than a quarter of a texel has not changed. Returns whether anything was rendered.
  // Leaves framebuffer, viewport, program and depth state changed.
  bool update(const SceneState& scene, const View& view, int size_px, GpuModels& models);

  // The occluders that `whole` (up to date with `scene`) was rendered from, over those parts of its maps, in the order
  // of kOccluderKinds; with as many texels. Glass and the bounds of depths are left out. Else as update().
  bool update_parts(const SunShadow& whole, const std::array<ShadowFit, 2>& parts, const SceneState& scene,
                    GpuModels& models);

  // fit.empty where nothing of that kind casts a shadow: there is no layer then.
  const ShadowMap& map(Occluders kind) const;

  const TranslucentMap& translucent() const;
  // Sets all that shaders/shadow/translucent.glsl declares.
  void bind_translucent(const View& view, const gl::Program& program) const;

  // Sets all that shaders/shadow/shadow_maps.glsl declares but the sun's disc. Needs bounds: not of cascades.
  void bind(const View& view, const gl::Program& program) const;
  // Binds the array of plain depths to that sampler: 0 to 1, an empty texel holds 1.
  void bind_depth(const gl::Program& program, std::string_view sampler) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace render
