#include "app/synth/texture.h"

#include <algorithm>
#include <cmath>

#include "app/synth/noise.h"
#include "app/synth/parallel.h"

namespace app::synth {

namespace {

constexpr float kMaxSlope = 1.6F;

std::uint8_t byte(float x) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(x, 0.0F, 1.0F) * 255.0F));
}

SurfacePoint mean(const SurfacePoint& a, const SurfacePoint& b, const SurfacePoint& c, const SurfacePoint& d) {
  SurfacePoint m;
  m.albedo = 0.25F * (a.albedo + b.albedo + c.albedo + d.albedo);
  m.sky_seen = 0.25F * (a.sky_seen + b.sky_seen + c.sky_seen + d.sky_seen);
  m.slope = 0.25F * (a.slope + b.slope + c.slope + d.slope);
  m.sun_seen = 0.25F * (a.sun_seen + b.sun_seen + c.sun_seen + d.sun_seen);
  m.gloss = 0.25F * (a.gloss + b.gloss + c.gloss + d.gloss);
  return m;
}

}  // namespace

// Albedo is kept as its square root, so that dark greens and soils do not band.
Texture::Texel Texture::encode(const SurfacePoint& p) {
  return {byte(std::sqrt(std::max(p.albedo.r, 0.0F))),
          byte(std::sqrt(std::max(p.albedo.g, 0.0F))),
          byte(std::sqrt(std::max(p.albedo.b, 0.0F))),
          byte(p.sky_seen),
          byte(0.5F + 0.5F * p.slope.x / kMaxSlope),
          byte(0.5F + 0.5F * p.slope.y / kMaxSlope),
          byte(p.sun_seen),
          byte(p.gloss)};
}

Texture::Texture(int size, float metres, const std::vector<SurfacePoint>& points) : metres_(metres) {
  std::vector<SurfacePoint> fine = points;
  for (int n = size; n >= 1; n /= 2) {
    Level level{n, std::vector<Texel>(fine.size())};
    std::transform(fine.begin(), fine.end(), level.texels.begin(), encode);
    levels_.push_back(std::move(level));
    const int half = n / 2;
    std::vector<SurfacePoint> coarse(static_cast<std::size_t>(half) * static_cast<std::size_t>(half));
    parallel_for(half, [&](int y) {
      for (int x = 0; x < half; ++x) {
        const auto at = [&](int dx, int dy) { return fine[static_cast<std::size_t>((2 * y + dy) * n + 2 * x + dx)]; };
        coarse[static_cast<std::size_t>(y * half + x)] = mean(at(0, 0), at(1, 0), at(0, 1), at(1, 1));
      }
    });
    fine = std::move(coarse);
  }
}

SurfacePoint Texture::sample(glm::vec2 uv_m, float footprint_m, float dither) const {
  const float finest = metres_ / static_cast<float>(levels_.front().size);
  const float wanted = std::log2(std::max(footprint_m / finest, 1e-3F)) + dither;
  const auto index = static_cast<std::size_t>(std::clamp(wanted, 0.0F, static_cast<float>(levels_.size() - 1)));
  const Level& level = levels_[index];
  const int mask = level.size - 1;
  const glm::vec2 at = uv_m / metres_ * static_cast<float>(level.size) - 0.5F;
  const int column = floor_of(at.x);
  const int row = floor_of(at.y);
  const glm::vec2 f = at - glm::vec2(column, row);
  const int x0 = column & mask;
  const int y0 = row & mask;
  const int x1 = (x0 + 1) & mask;
  const int y1 = (y0 + 1) & mask;
  const Texel* const row0 = level.texels.data() + static_cast<std::ptrdiff_t>(y0) * level.size;
  const Texel* const row1 = level.texels.data() + static_cast<std::ptrdiff_t>(y1) * level.size;
  const auto wx = static_cast<int>(f.x * 16.0F);
  const auto wy = static_cast<int>(f.y * 16.0F);
  const Texel &a = row0[x0], &b = row0[x1], &c = row1[x0], &d = row1[x1];
  std::array<float, 8> mixed;
  for (std::size_t i = 0; i < 8; ++i) {
    const int top = a[i] * (16 - wx) + b[i] * wx;
    const int bottom = c[i] * (16 - wx) + d[i] * wx;
    mixed[i] = static_cast<float>(top * (16 - wy) + bottom * wy) * (1.0F / (256.0F * 255.0F));
  }
  SurfacePoint p;
  const glm::vec3 root(mixed[0], mixed[1], mixed[2]);
  p.albedo = root * root;
  p.sky_seen = mixed[3];
  p.slope = (glm::vec2(mixed[4], mixed[5]) - 0.5F) * 2.0F * kMaxSlope;
  p.sun_seen = mixed[6];
  p.gloss = mixed[7];
  return p;
}

}  // namespace app::synth
