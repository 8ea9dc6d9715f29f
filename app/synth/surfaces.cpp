#include "app/synth/surfaces.h"

#include <algorithm>
#include <cmath>

#include "app/synth/noise.h"
#include "app/synth/parallel.h"
#include "app/synth/relief.h"

namespace app::synth {
namespace {

// Slopes, the sky that hollows lose and the sun that the relief itself takes away.
Texture finish(int size, float metres, const std::vector<Relief>& reliefs, const std::optional<glm::vec3>& sun) {
  const float texel = metres / static_cast<float>(size);
  const int mask = size - 1;
  const auto at = [&](int x, int y) -> const Relief& {
    return reliefs[static_cast<std::size_t>((y & mask) * size + (x & mask))];
  };
  std::vector<SurfacePoint> points(reliefs.size());
  parallel_for(size, [&](int y) {
    for (int x = 0; x < size; ++x) {
      const Relief& here = at(x, y);
      SurfacePoint& p = points[static_cast<std::size_t>(y * size + x)];
      p.albedo = here.albedo;
      p.gloss = here.gloss;
      p.slope =
          -glm::vec2(at(x + 1, y).height_m - at(x - 1, y).height_m, at(x, y + 1).height_m - at(x, y - 1).height_m) /
          (2.0F * texel);
      float higher = 0.0F;
      for (const glm::ivec2& step : {glm::ivec2(3, 1), glm::ivec2(-1, 3), glm::ivec2(-3, -1), glm::ivec2(1, -3)})
        higher += std::max(at(x + step.x, y + step.y).height_m - here.height_m, 0.0F);
      p.sky_seen = 1.0F / (1.0F + 0.35F * higher / (3.2F * texel));
      if (!sun || sun->z <= 0.02F) continue;
      const float flat = glm::length(glm::vec2(*sun));
      const glm::vec2 step = glm::vec2(*sun) / std::max(flat, 1e-4F);
      const float rise = sun->z / std::max(flat, 1e-4F) * texel;
      float lit = 1.0F;
      for (int k = 1; k <= 12; ++k) {
        const float above = at(x + static_cast<int>(std::lround(step.x * static_cast<float>(k))),
                               y + static_cast<int>(std::lround(step.y * static_cast<float>(k))))
                                .height_m -
                            here.height_m - rise * static_cast<float>(k);
        lit = std::min(lit, 1.0F - above / (0.6F * rise + 0.0006F));
      }
      p.sun_seen = std::max(lit, 0.0F);
    }
  });
  return {size, metres, points};
}

// A square field of `size` texels a side, in blocks; one that is not `wanted` (its middle, its radius) is of one piece.
template <typename Field, typename Wanted>
std::vector<Relief> fill(int size, float metres, Field&& field, Wanted&& wanted) {
  std::vector<Relief> reliefs(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  const float texel = metres / static_cast<float>(size);
  const int side = std::min(size, 32);
  const int blocks = size / side;
  parallel_for(blocks * blocks, [&](int block) {
    const glm::ivec2 first = side * glm::ivec2(block % blocks, block / blocks);
    const float width = static_cast<float>(side) * texel;
    const glm::vec2 middle = glm::vec2(first) * texel + 0.5F * width;
    const bool fine = wanted(middle, width);
    const Relief flat = fine ? Relief() : field(middle);
    for (int y = first.y; y < first.y + side; ++y) {
      for (int x = first.x; x < first.x + side; ++x)
        reliefs[static_cast<std::size_t>(y * size + x)] = fine ? field((glm::vec2(x, y) + 0.5F) * texel) : flat;
    }
  });
  return reliefs;
}

// Repeats without a seam: over the last fifth the field fades into itself one side earlier.
template <typename Field>
Relief seamless(glm::vec2 p, float side, Field&& field) {
  const auto weight = [&](float x) { return smooth_ramp(0.8F * side, side, x); };
  const float wx = weight(p.x);
  const float wy = weight(p.y);
  Relief r = field(p);
  if (wx > 0.0F) r = blend(r, field(p - glm::vec2(side, 0.0F)), wx);
  if (wy > 0.0F) {
    Relief below = field(p - glm::vec2(0.0F, side));
    if (wx > 0.0F) below = blend(below, field(p - glm::vec2(side)), wx);
    r = blend(r, below, wy);
  }
  return r;
}

bool everywhere(const glm::vec2& /*middle*/, float /*reach*/) {
  return true;
}

}  // namespace

const std::vector<std::string>& ground_surfaces() {
  static const std::vector<std::string> kNames{"paving", "gravel", "lawn", "checker", "plain"};
  return kNames;
}

const std::vector<std::string>& box_surfaces() {
  static const std::vector<std::string> kNames{"brick", "stone", "plaster", "concrete", "terracotta", "wood"};
  return kNames;
}

GroundTextures bake_ground(const GroundSpec& ground, const glm::vec2& eye, const glm::vec2& focus,
                           const glm::vec3& sun_direction, const Gaze& gaze, std::uint32_t seed) {
  const bool even = ground.surface == "plain" && ground.around == "plain";  // nothing to resolve
  const int size = even ? 16 : 2048;
  const int around_size = even ? 16 : 1024;
  constexpr float kAroundMetres = 8.0F;
  GroundTextures textures;
  constexpr float kFineMetres = 7.168F;     // 3.5 mm a texel
  constexpr float kCoarseMetres = 18.432F;  // 9 mm
  const glm::vec2 ahead = focus == eye ? glm::vec2(0.0F) : glm::normalize(focus - eye);
  const glm::vec2 fine_middle = eye + 4.6F * ahead;
  const auto bake = [&](float metres, const glm::vec2& middle) {
    const glm::vec2 origin = middle - 0.5F * metres;
    const auto wanted = [&](const glm::vec2& at, float reach) {
      const glm::vec2 inside = 0.5F * kFineMetres - glm::abs(origin + at - fine_middle);
      const bool hidden = metres > kFineMetres && std::min(inside.x, inside.y) > 2.0F * reach;  // the fine part has it
      return !hidden && gaze.sees(glm::vec3(origin + at, 0.0F), reach);
    };
    const auto field = [&](glm::vec2 p) { return ground_relief(ground, origin + p, seed); };
    return GroundTextures::Part{finish(size, metres, fill(size, metres, field, wanted), sun_direction), origin};
  };
  textures.parts = {bake(kFineMetres, fine_middle), bake(kCoarseMetres, focus)};
  const std::string& around = ground.extent[2] - ground.extent[0] > 1e3 ? ground.surface : ground.around;
  const auto field = [&](glm::vec2 p) {
    return seamless(p, kAroundMetres, [&](glm::vec2 q) { return simple_ground(around, q, seed); });
  };
  textures.around =
      finish(around_size, kAroundMetres, fill(around_size, kAroundMetres, field, everywhere), sun_direction);
  return textures;
}

Texture bake_box_surface(const std::string& surface, std::uint32_t seed) {
  constexpr int kSize = 1024;
  constexpr float kMetres = 8.192F;
  const auto field = [&](glm::vec2 p) { return box_relief(surface, p, seed); };
  return finish(kSize, kMetres, fill(kSize, kMetres, field, everywhere), {});
}

}  // namespace app::synth
