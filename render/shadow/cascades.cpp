#include "render/shadow/cascades.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/gl/extensions.h"

namespace render {
namespace {

// Share of the whole map's texels that the visible medium takes up, above which a map of its own is not worth being
// drawn.
constexpr double kHardlyFiner = 0.75;

// Texels that are seen wider than this are worth a part of their own, if that much of the light that the map's medium
// scatters to the eye comes from so near, and the part's texels are that much finer.
constexpr double kWidestTexelPx = 8.0;
constexpr double kLeastShare = 0.1;
constexpr double kFiner = 0.7;
constexpr std::size_t kMostCascades = 4;

double area(const ShadowFit& fit) {
  return fit.empty ? 0.0 : fit.metres_per_unit.x * fit.metres_per_unit.y;
}

double texel_m(const ShadowFit& fit, int size_px) {
  return std::max(fit.metres_per_unit.x, fit.metres_per_unit.y) / size_px;
}

// Down to half an octave, so that it seldom moves.
double in_steps(double distance_m) {
  return std::exp2(0.5 * std::floor(2.0 * std::log2(distance_m)));
}

}  // namespace

std::vector<AxisRange> split_cascades(const ShadowFit& whole, const ShadowFit& seen_of_whole, int size_px,
                                      const View& view, const Medium& medium, const VisibleDepth& seen) {
  std::vector<AxisRange> ranges{{}};
  ShadowFit nearest = seen_of_whole;
  const double extinction = extinction_at(medium, view.eye_in_world);
  const double most = scattered_fraction(extinction, glm::length(nearest.metres_per_unit));
  while (ranges.size() < kMostCascades && !nearest.empty) {
    const double texel = texel_m(nearest, size_px);
    const double split_m = in_steps(texel * std::min(view.focal_px.x, view.focal_px.y) / kWidestTexelPx);
    if (split_m >= ranges.front().to_m || scattered_fraction(extinction, split_m) <= kLeastShare * most) break;
    nearest = fit_to_visible_medium(whole, size_px, view, medium, seen, {0.0, split_m});
    if (!nearest.empty && texel_m(nearest, size_px) > kFiner * texel) break;
    ranges.front().from_m = split_m;
    ranges.insert(ranges.begin(), {0.0, split_m});
  }
  return ranges;
}

const SunShadow& CascadedShadow::maps_of(std::size_t part, const Fits& fits, const SunShadow& shadow,
                                         const SceneState& scene, GpuModels& models) {
  bool finer = false;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    finer = finer || area(fits[i]) < kHardlyFiner * area(shadow.map(kOccluderKinds[i]).fit);
  }
  if (!finer) return shadow;
  while (maps_.size() <= part) maps_.push_back(std::make_unique<SunShadow>());
  maps_[part]->update_parts(shadow, fits, scene, models);
  return *maps_[part];
}

std::span<const Cascade> CascadedShadow::update(const SunShadow& shadow, const SceneState& scene, const View& view,
                                                GLuint depth, GpuModels& models) {
  const Medium& medium = *scene.medium;
  const VisibleDepth seen = seen_.read(view, depth);
  const auto fits_to = [&](const AxisRange& range) {
    Fits fits;
    for (std::size_t i = 0; i < fits.size(); ++i) {
      const ShadowMap& map = shadow.map(kOccluderKinds[i]);
      fits[i] = fit_to_visible_medium(map.fit, map.size_px, view, medium, seen, range);
    }
    return fits;
  };
  const Fits of_all = fits_to({});
  std::vector<AxisRange> ranges{{}};
  for (std::size_t i = 0; i < of_all.size(); ++i) {
    if (!gl::extensions().float_blend) break;  // techniques add parts up in 32-bit floats
    const ShadowMap& map = shadow.map(kOccluderKinds[i]);
    std::vector<AxisRange> found = split_cascades(map.fit, of_all[i], map.size_px, view, medium, seen);
    if (found.size() > ranges.size()) ranges = std::move(found);
  }
  parts_.clear();
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const Fits fits = ranges[i].all() ? of_all : fits_to(ranges[i]);
    // Nothing to draw, and as if all of it were lit; but among other parts the technique still has to look.
    const bool none = std::ranges::all_of(fits, [](const ShadowFit& fit) { return fit.empty; });
    const SunShadow& maps = none && ranges.size() > 1 ? shadow : maps_of(i, fits, shadow, scene, models);
    if (!parts_.empty() && parts_.back().maps == &maps) {
      parts_.back().range.to_m = ranges[i].to_m;
    } else {
      parts_.push_back({&maps, ranges[i]});
    }
  }
  return parts_;
}

}  // namespace render
