#include "render/shadow/air_shadow.h"

#include <array>

namespace render {
namespace {

// Share of the whole map's texels that the seen air takes up, above which a map of its own is not worth being drawn.
constexpr double kHardlyFiner = 0.75;

double area(const ShadowFit& fit) {
  return fit.empty ? 0.0 : fit.metres_per_unit.x * fit.metres_per_unit.y;
}

}  // namespace

const SunShadow& AirShadow::update(const SunShadow& shadow, const SceneState& scene, const View& view, GLuint depth,
                                   GpuModels& models) {
  const SeenDepth seen = seen_.read(view, depth);
  std::array<ShadowFit, 2> parts;
  bool finer = false;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const ShadowMap& map = shadow.map(kCasterKinds[i]);
    parts[i] = fit_to_seen_air(map.fit, map.size_px, view, *scene.medium, seen);
    finer = finer || area(parts[i]) < kHardlyFiner * area(map.fit);
  }
  if (!finer) return shadow;
  maps_.update_parts(shadow, parts, scene, models);
  return maps_;
}

}  // namespace render
