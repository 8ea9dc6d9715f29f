#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace app::synth {

// A good 32-bit mix of its argument (Wellons' lowbias32): equal seeds give equal pictures on every machine.
inline std::uint32_t mix_bits(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  x ^= x >> 16;
  return x;
}

inline std::uint32_t hash_cell(int x, int y, std::uint32_t seed) {
  return mix_bits(static_cast<std::uint32_t>(x) * 0x9e3779b1U ^ mix_bits(static_cast<std::uint32_t>(y) + seed));
}

// 24 bits as a number in [0, 1).
inline float unit_float(std::uint32_t bits) {
  return static_cast<float>(static_cast<std::int32_t>(bits >> 8)) * (1.0F / 16777216.0F);
}

// A small generator for one pixel, leaf or row.
class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(mix_bits(seed ^ 0x68bc21ebU)) {}
  float next() {
    state_ = state_ * 747796405U + 2891336453U;
    const std::uint32_t word = ((state_ >> ((state_ >> 28U) + 4U)) ^ state_) * 277803737U;  // PCG-RXS-M-XS 32
    return unit_float((word >> 22U) ^ word);
  }
  float between(float low, float high) { return low + (high - low) * next(); }
  // Standard normal: sum of four uniforms is smooth enough for leaves and stones, not for sensor noise.
  float bell() { return (next() + next() + next() + next() - 2.0F) * 1.7320508F; }

 private:
  std::uint32_t state_;
};

// The next integer below or at x, |x| < 2^31; the library's floor is a call where the processor's is not used.
inline int floor_of(float x) {
  const int towards_zero = static_cast<int>(x);
  return towards_zero - (x < static_cast<float>(towards_zero) ? 1 : 0);
}

inline float smooth_ramp(float from, float to, float x) {
  const float t = glm::clamp((x - from) / (to - from), 0.0F, 1.0F);
  return t * t * (3.0F - 2.0F * t);
}

// Smooth random field over the plane with features of size 1, values in [0, 1] (value noise, quintic fade).
inline float value_noise(glm::vec2 p, std::uint32_t seed) {
  const int x = floor_of(p.x);
  const int y = floor_of(p.y);
  const glm::vec2 f = p - glm::vec2(x, y);
  const glm::vec2 u = f * f * f * (f * (f * 6.0F - 15.0F) + 10.0F);
  const std::uint32_t west = static_cast<std::uint32_t>(x) * 0x9e3779b1U;  // hash_cell's parts, shared by the four
  const std::uint32_t east = west + 0x9e3779b1U;
  const std::uint32_t south = mix_bits(static_cast<std::uint32_t>(y) + seed);
  const std::uint32_t north = mix_bits(static_cast<std::uint32_t>(y) + 1U + seed);
  const float a = unit_float(mix_bits(west ^ south));
  const float b = unit_float(mix_bits(east ^ south));
  const float c = unit_float(mix_bits(west ^ north));
  const float d = unit_float(mix_bits(east ^ north));
  return glm::mix(glm::mix(a, b, u.x), glm::mix(c, d, u.x), u.y);
}

// Octaves of value noise, each at 2.03 times the frequency and `gain` times the weight; mean 0.5, in [0, 1].
inline float fractal_noise(glm::vec2 p, int octaves, std::uint32_t seed, float gain = 0.5F) {
  float sum = 0.0F;
  float weight = 1.0F;
  float total = 0.0F;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * value_noise(p, seed + static_cast<std::uint32_t>(i) * 101U);
    total += weight;
    weight *= gain;
    p = glm::vec2(0.8F * p.x - 0.6F * p.y, 0.6F * p.x + 0.8F * p.y) * 2.03F + 17.3F;  // turned: hides the lattice
  }
  return sum / total;
}

}  // namespace app::synth
