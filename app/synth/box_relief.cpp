#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/synth/noise.h"
#include "app/synth/relief.h"
#include "app/synth/stones.h"

namespace app::synth {
namespace {

Relief brick(glm::vec2 p, std::uint32_t seed) {
  constexpr glm::vec2 kBrick(0.256F, 0.082F);
  const float course = std::floor(p.y / kBrick.y);
  const float shift = 0.5F * (course - 2.0F * std::floor(course / 2.0F));
  const glm::vec2 in(p.x / kBrick.x + shift, p.y / kBrick.y);
  const glm::vec2 cell = glm::floor(in);
  const glm::vec2 f = (in - cell) * kBrick;
  const float rough = 0.006F * (fractal_noise(p * 45.0F, 3, seed + 51U) - 0.5F);
  const float inside = std::min({f.x, kBrick.x - f.x, f.y, kBrick.y - f.y}) - 0.006F + rough;
  const std::uint32_t h = hash_cell(static_cast<int>(cell.x), static_cast<int>(cell.y), seed + 52U);
  const float grain = fractal_noise(p * 110.0F, 3, seed + 53U);
  const float stain = fractal_noise(p * 1.4F, 4, seed + 54U);
  const glm::vec3 fired = glm::mix(glm::vec3(0.30F, 0.125F, 0.075F), glm::vec3(0.42F, 0.22F, 0.13F), unit_float(h));
  const float soot = smooth_ramp(0.8F, 1.0F, unit_float(mix_bits(h + 1U)));
  const float on = smooth_ramp(-0.001F, 0.004F, inside);
  Relief r;
  const glm::vec3 face = glm::mix(fired, glm::vec3(0.14F, 0.085F, 0.07F), 0.6F * soot) * (0.65F + 0.7F * grain);
  r.albedo = glm::mix(glm::vec3(0.40F, 0.375F, 0.335F) * (0.7F + 0.5F * grain), face, on) * (0.72F + 0.5F * stain);
  r.height_m = on * (0.007F + 0.002F * unit_float(mix_bits(h + 2U))) + 0.0015F * grain;
  return r;
}

// A dry-stone wall: courses of squared rubble.
Relief rubble(glm::vec2 p, std::uint32_t seed) {
  const glm::vec2 wobble(fractal_noise(p * 5.0F, 3, seed + 61U), fractal_noise(p * 5.0F + 9.0F, 3, seed + 62U));
  const glm::vec2 q = (p + 0.05F * (wobble - 0.5F)) * glm::vec2(3.4F, 6.6F);
  const Stone stone = find_stone(q, seed + 63U);
  const std::uint32_t h = hash_cell(stone.cell.x, stone.cell.y, seed + 64U);
  const float inside = stone.border - 0.05F;
  const float on = smooth_ramp(-0.01F, 0.03F, inside);
  const float face = fractal_noise(p * 9.0F + glm::vec2(h & 31U, h >> 27U), 5, seed + 65U, 0.55F);
  const float grain = fractal_noise(p * 120.0F, 3, seed + 66U);
  const float stain = fractal_noise(p * 1.1F, 4, seed + 67U);
  Relief r;
  const glm::vec3 colour = stone_colour(h) * (0.55F + 0.6F * face + 0.25F * grain);
  r.albedo = glm::mix(glm::vec3(0.10F, 0.085F, 0.065F), colour, on) * (0.72F + 0.5F * stain);
  r.height_m = 0.030F * (1.0F - std::exp(-std::max(inside, 0.0F) / 0.12F)) + 0.012F * face + 0.002F * grain;
  return r;
}

Relief plaster(glm::vec2 p, std::uint32_t seed) {
  const float trowel = fractal_noise(p * glm::vec2(7.0F, 9.0F), 5, seed + 71U);
  const float grain = fractal_noise(p * 150.0F, 3, seed + 72U);
  const float cloud = fractal_noise(p * 0.9F, 5, seed + 73U, 0.6F);
  const float drip = fractal_noise(p * glm::vec2(5.0F, 0.35F), 4, seed + 74U);
  const float damp = smooth_ramp(0.9F, 0.0F, p.y + 0.9F * (cloud - 0.5F));
  Relief r;
  r.albedo = glm::mix(glm::vec3(0.56F, 0.44F, 0.29F), glm::vec3(0.64F, 0.53F, 0.37F), cloud);
  r.albedo *= (0.86F + 0.18F * trowel + 0.10F * grain) * (0.80F + 0.28F * drip);
  r.albedo = glm::mix(r.albedo, r.albedo * glm::vec3(0.58F, 0.57F, 0.55F), 0.75F * damp);
  r.height_m = 0.005F * trowel + 0.0012F * grain;
  return r;
}

Relief concrete(glm::vec2 p, std::uint32_t seed) {
  const float cloud = fractal_noise(p * 2.2F, 5, seed + 81U);
  const float grain = fractal_noise(p * 130.0F, 3, seed + 82U);
  const float pore = smooth_ramp(0.78F, 0.86F, fractal_noise(p * 48.0F, 2, seed + 83U));
  Relief r;
  r.albedo = glm::vec3(0.42F, 0.405F, 0.375F) * (0.72F + 0.42F * cloud + 0.14F * grain) * (1.0F - 0.5F * pore);
  r.height_m = 0.002F * cloud + 0.0007F * grain - 0.002F * pore;
  return r;
}

Relief terracotta(glm::vec2 p, std::uint32_t seed) {
  const float cloud = fractal_noise(p * 3.5F, 5, seed + 91U);
  const float grain = fractal_noise(p * 160.0F, 3, seed + 92U);
  const float bloom = smooth_ramp(0.52F, 0.75F, fractal_noise(p * 5.0F + 3.0F, 4, seed + 93U));
  Relief r;
  r.albedo = glm::mix(glm::vec3(0.37F, 0.165F, 0.085F), glm::vec3(0.47F, 0.245F, 0.14F), cloud) * (0.8F + 0.3F * grain);
  r.albedo = glm::mix(r.albedo, glm::vec3(0.52F, 0.46F, 0.40F), 0.45F * bloom);
  r.height_m = 0.0015F * cloud + 0.0006F * grain;
  return r;
}

Relief wood(glm::vec2 p, std::uint32_t seed) {
  constexpr float kBoard = 0.12F;
  const float board = std::floor(p.y / kBoard);
  const float f = p.y - board * kBoard;
  const std::uint32_t h = hash_cell(static_cast<int>(board), 7, seed + 94U);
  const glm::vec2 q(p.x * 2.2F + 30.0F * unit_float(h), p.y * 75.0F);
  const float fibre = fractal_noise(q, 4, seed + 95U);
  const float ring = 0.5F + 0.5F * std::sin(24.0F * fractal_noise(q * glm::vec2(0.5F, 0.06F), 3, seed + 96U));
  const float gap = smooth_ramp(0.001F, 0.006F, std::min(f, kBoard - f));
  Relief r;
  r.albedo = glm::mix(glm::vec3(0.22F, 0.15F, 0.095F), glm::vec3(0.36F, 0.27F, 0.185F), 0.6F * fibre + 0.4F * ring);
  r.albedo *= (0.8F + 0.4F * unit_float(mix_bits(h))) * (0.12F + 0.88F * gap);
  r.height_m = 0.006F * gap + 0.001F * fibre;
  return r;
}

}  // namespace

Relief box_relief(const std::string& surface, glm::vec2 p, std::uint32_t seed) {
  if (surface == "brick") return brick(p, seed);
  if (surface == "stone") return rubble(p, seed);
  if (surface == "plaster") return plaster(p, seed);
  if (surface == "terracotta") return terracotta(p, seed);
  if (surface == "wood") return wood(p, seed);
  if (surface == "concrete") return concrete(p, seed);
  throw std::invalid_argument("no such box surface: " + surface);
}

}  // namespace app::synth
