#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace generator {

// A number in [0, 1) for a lattice point.
inline float hash(int x, int y, std::uint32_t seed) {
  std::uint32_t h =
      static_cast<std::uint32_t>(x) * 0x8DA6B343U ^ static_cast<std::uint32_t>(y) * 0xD8163841U ^ seed * 0xCB1AB31FU;
  h = (h ^ h >> 15) * 0x2C1B3C6DU;
  h = (h ^ h >> 12) * 0x297A2D39U;
  return static_cast<float>((h ^ h >> 15) >> 8) * 0x1p-24F;
}

// Value noise in [-1, 1] that repeats every `period` lattice points.
inline float noise(const glm::vec2& p, const glm::ivec2& period, std::uint32_t seed) {
  const glm::vec2 floor = glm::floor(p);
  const glm::vec2 f = p - floor;
  const glm::vec2 s = f * f * f * (f * (f * 6.0F - 15.0F) + 10.0F);
  const auto wrap = [](int i, int n) { return (i % n + n) % n; };
  const int x0 = wrap(static_cast<int>(floor.x), period.x);
  const int y0 = wrap(static_cast<int>(floor.y), period.y);
  const int x1 = wrap(x0 + 1, period.x);
  const int y1 = wrap(y0 + 1, period.y);
  const float low = glm::mix(hash(x0, y0, seed), hash(x1, y0, seed), s.x);
  const float high = glm::mix(hash(x0, y1, seed), hash(x1, y1, seed), s.x);
  return 2.0F * glm::mix(low, high, s.y) - 1.0F;
}

// Octaves of noise, each twice as fine and half as strong, about within [-1, 1]. `p` in units of the coarsest lattice.
inline float fractal(glm::vec2 p, glm::ivec2 period, int octaves, std::uint32_t seed) {
  float sum = 0.0F;
  float strength = 0.5F;
  for (int i = 0; i < octaves; ++i) {
    sum += strength * noise(p, period, seed + static_cast<std::uint32_t>(i));
    p *= 2.0F;
    period *= 2;
    strength *= 0.5F;
  }
  return sum * 1.3F;
}

}  // namespace generator
