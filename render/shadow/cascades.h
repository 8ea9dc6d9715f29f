#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "render/shadow/sun_shadow.h"
#include "render/shadow/visible_medium.h"

namespace render {

// The medium in a range of distances, and the maps to look for its occluders in.
struct Cascade {
  const SunShadow* maps = nullptr;
  AxisRange range;
};

// The ranges that the medium in a map's fit is parted into, nearest first: where the map's texels would be seen much
// wider than a pixel in a good share of the medium, what lies so near is parted off for a map of its own; and so on
// (z-partitions as Zhang et al. 2006, "Parallel-split shadow maps", placed by what is seen instead of by a scheme). One
// range where that is not so. They move in steps, so that a moving view seldom needs new maps. `seen_of_whole`:
// fit_to_visible_medium() the whole, at any distance.
std::vector<AxisRange> split_cascades(const ShadowFit& whole, const ShadowFit& seen_of_whole, int size_px,
                                      const View& view, const Medium& medium, const VisibleDepth& seen);

// The sun's shadow maps once more, for the medium: only over that part of it which is seen, so that their texels are
// finer than those of the maps for surfaces, which keep still while the view moves; and in z-partitions where the view
// reaches so far that those near the eye would be coarse.
class CascadedShadow {
 public:
  // All of the medium, nearest parts first, and the maps to look for its occluders in: its own, drawn again when the
  // part that is seen has changed by more than a step; or `shadow` (up to date) where their texels would be hardly
  // finer. `depth`: as ShaftInputs has it. Valid until the next call. Waits for the GL, and leaves framebuffer,
  // viewport, program and depth state changed.
  std::span<const Cascade> update(const SunShadow& shadow, const SceneState& scene, const View& view, GLuint depth,
                                  GpuModels& models);

 private:
  using Fits = std::array<ShadowFit, kOccluderKinds.size()>;
  const SunShadow& maps_of(std::size_t part, const Fits& fits, const SunShadow& shadow, const SceneState& scene,
                           GpuModels& models);

  VisibleDepthPass seen_;
  std::vector<std::unique_ptr<SunShadow>> maps_;
  std::vector<Cascade> parts_;
};

}  // namespace render
