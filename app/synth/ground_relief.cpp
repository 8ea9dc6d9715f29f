#include <algorithm>
#include <array>
#include <cmath>

#include "app/synth/noise.h"
#include "app/synth/relief.h"
#include "app/synth/stones.h"

namespace app::synth {
namespace {

Relief soil(glm::vec2 p, std::uint32_t seed) {
  const float grain = fractal_noise(p * 140.0F, 3, seed + 1U);
  const float patch = fractal_noise(p * 2.3F, 3, seed + 2U);
  Relief r;
  r.albedo = glm::mix(glm::vec3(0.10F, 0.075F, 0.05F), glm::vec3(0.21F, 0.17F, 0.125F), patch) * (0.55F + 0.9F * grain);
  r.height_m = 0.004F * grain;
  return r;
}

// Grass seen from above: blades as stretched noise in drifting directions, clumps, dry patches, daisies.
Relief lawn(glm::vec2 p, std::uint32_t seed) {
  const float turn = 6.3F * value_noise(p * 1.7F, seed + 11U);
  const glm::vec2 along(std::cos(turn), std::sin(turn));
  const glm::vec2 q(glm::dot(p, along), glm::dot(p, glm::vec2(-along.y, along.x)));
  const float blade = fractal_noise(q * glm::vec2(45.0F, 240.0F), 2, seed + 12U);
  const float tuft = fractal_noise(p * 14.0F, 4, seed + 13U);
  const float clump = fractal_noise(p * 2.6F, 3, seed + 14U);
  const float dry = smooth_ramp(0.50F, 0.78F, fractal_noise(p * 0.55F, 3, seed + 15U));
  const float height = 0.35F * blade + 0.45F * tuft + 0.2F * clump;
  glm::vec3 green = glm::mix(glm::vec3(0.030F, 0.055F, 0.014F), glm::vec3(0.115F, 0.165F, 0.040F), height);
  green = glm::mix(green, glm::vec3(0.20F, 0.18F, 0.085F) * (0.5F + height), 0.65F * dry);
  Relief r;
  r.albedo = green * (0.55F + 0.9F * blade);
  r.height_m = 0.030F * height + 0.012F * blade;
  const glm::ivec2 cell(floor_of(p.x * 9.0F), floor_of(p.y * 9.0F));
  const std::uint32_t h = hash_cell(cell.x, cell.y, seed + 16U);
  if (unit_float(h) > 0.985F && clump > 0.52F) {  // a daisy
    const glm::vec2 centre = (glm::vec2(cell) + 0.5F) / 9.0F;
    const float d = glm::length(p - centre);
    if (d < 0.011F) r.albedo = d < 0.0035F ? glm::vec3(0.62F, 0.45F, 0.06F) : glm::vec3(0.78F, 0.77F, 0.74F);
  }
  return r;
}

Relief gravel(glm::vec2 p, std::uint32_t seed) {
  const Stone pebble = find_stone(p * 62.0F, seed + 21U);
  const Stone chip = find_stone(p * 131.0F, seed + 22U);
  const std::uint32_t h = hash_cell(pebble.cell.x, pebble.cell.y, seed + 23U);
  const float dome = std::sqrt(glm::clamp(pebble.border * 2.4F, 0.0F, 1.0F));
  const float tone = unit_float(h);
  const float patch = fractal_noise(p * 0.9F, 4, seed + 24U);
  Relief r;
  r.albedo = glm::mix(glm::vec3(0.24F, 0.205F, 0.165F), glm::vec3(0.50F, 0.455F, 0.385F), tone * tone);
  if (tone > 0.93F) r.albedo = {0.62F, 0.60F, 0.56F};
  r.albedo *= (0.55F + 0.45F * dome) * (0.8F + 0.4F * patch) * (0.9F + 0.2F * unit_float(mix_bits(h + 3U)));
  r.height_m = 0.010F * dome + 0.002F * std::min(chip.border, 0.3F);
  return r;
}

constexpr float kStonesPerMetre = 1.9F;

// The riven, worn top of one flagstone; `inside`: metres from its edge.
Relief stone_face(glm::vec2 p, const Stone& stone, float inside, std::uint32_t seed) {
  const std::uint32_t h = hash_cell(stone.cell.x, stone.cell.y, seed + 34U);
  const float riven = fractal_noise(p * 5.0F + glm::vec2(h & 63U, h >> 26U), 6, seed + 37U, 0.55F);
  const float grain = fractal_noise(p * 95.0F, 3, seed + 38U, 0.6F);
  const float stain = fractal_noise(p * 0.75F, 5, seed + 39U, 0.55F);
  const float blotch = fractal_noise(p * 9.0F + 7.0F, 4, seed + 40U);
  const float pits = smooth_ramp(0.70F, 0.86F, fractal_noise(p * 55.0F, 3, seed + 41U));
  const glm::vec2 tilt = 0.010F * (glm::vec2(unit_float(mix_bits(h + 7U)), unit_float(mix_bits(h + 8U))) - 0.5F);
  const float edge = 1.0F - std::exp(-std::max(inside, 0.0F) / 0.010F);
  Relief face;
  face.albedo = stone_colour(h) * (0.62F + 0.36F * riven + 0.26F * grain) * (0.80F + 0.34F * blotch);
  face.albedo *= 1.0F - 0.45F * pits;
  face.albedo *= glm::mix(glm::vec3(1.08F), glm::vec3(0.60F, 0.585F, 0.56F), smooth_ramp(0.42F, 0.72F, stain));
  face.albedo *= 0.78F + 0.22F * edge;  // dirt gathers along the joints
  const float lichen = smooth_ramp(0.66F, 0.74F, fractal_noise(p * 11.0F + 90.0F, 4, seed + 42U)) *
                       smooth_ramp(0.52F, 0.62F, fractal_noise(p * 0.9F + 5.0F, 2, seed + 43U));
  face.albedo = glm::mix(face.albedo, glm::vec3(0.50F, 0.49F, 0.41F) * (0.7F + 0.5F * grain), 0.55F * lichen);
  face.height_m = 0.008F * edge + 0.0055F * riven + 0.0011F * grain - 0.003F * pits + 0.004F * unit_float(h) +
                  glm::dot(tilt, kStonesPerMetre * p - stone.centre) + 0.008F;
  face.gloss = 0.45F * edge * (1.0F - 0.6F * lichen) * (0.4F + riven);
  return face;
}

// Sand and soil between the stones, mossy here and there.
Relief stone_joint(glm::vec2 p, std::uint32_t seed) {
  Relief joint = soil(p, seed + 44U);
  const float moss = smooth_ramp(0.46F, 0.60F, fractal_noise(p * 1.3F + 3.0F, 4, seed + 45U));
  const float cushion = fractal_noise(p * 80.0F, 3, seed + 46U);
  joint.albedo = glm::mix(joint.albedo, glm::vec3(0.055F, 0.085F, 0.020F) * (0.45F + 1.3F * cushion), 0.9F * moss);
  joint.height_m += moss * (0.006F + 0.006F * cushion);
  return joint;
}

// Natural flagstones: riven faces, worn rounded edges, joints of sand and soil with moss where it is shady.
struct Paving {
  Relief relief;
  float joint = 0.0F;  // 1 in the joint, 0 on a stone
};

Paving paving(glm::vec2 p, std::uint32_t seed, bool stone_missing(glm::vec2 centre_m, const void* user),
              const void* user) {
  const glm::vec2 wobble(fractal_noise(p * 3.1F, 4, seed + 31U), fractal_noise(p * 3.1F + 40.0F, 4, seed + 32U));
  const glm::vec2 q = (p + 0.085F * (wobble - 0.5F)) * kStonesPerMetre;
  const Stone stone = find_stone(q, seed + 33U);
  const float border_m = stone.border / kStonesPerMetre;
  const float half_joint = 0.005F + 0.009F * fractal_noise(p * 6.0F, 2, seed + 35U);
  const float chips = 0.010F * (fractal_noise(p * 38.0F, 3, seed + 36U) - 0.5F);
  const float inside = border_m + chips - half_joint;
  Paving out;
  out.joint = 1.0F - smooth_ramp(-0.002F, 0.004F, inside);
  if (stone_missing(stone.centre / kStonesPerMetre, user)) {
    out.joint = 2.0F;  // no stone was laid here
    return out;
  }
  Relief face;
  if (out.joint < 1.0F) face = stone_face(p, stone, inside, seed);
  Relief joint;
  if (out.joint > 0.0F) joint = stone_joint(p, seed);
  out.relief = blend(face, joint, out.joint);
  return out;
}

Relief checker(glm::vec2 p) {
  const glm::ivec2 cell(glm::floor(p * 2.0F));
  return {((cell.x + cell.y) & 1) != 0 ? glm::vec3(0.55F) : glm::vec3(0.12F), 0.0F, 0.0F};
}

bool outside_extent(glm::vec2 centre, const void* user) {
  const auto& e = *static_cast<const std::array<double, 4>*>(user);
  return centre.x < e[0] || centre.x > e[2] || centre.y < e[1] || centre.y > e[3];
}

}  // namespace

Relief simple_ground(const std::string& surface, glm::vec2 p, std::uint32_t seed) {
  if (surface == "lawn") return lawn(p, seed);
  if (surface == "gravel") return gravel(p, seed);
  if (surface == "checker") return checker(p);
  if (surface == "plain") return {glm::vec3(0.35F), 0.0F, 0.0F};
  static constexpr std::array<double, 4> kEverywhere{-1e9, -1e9, 1e9, 1e9};
  return paving(p, seed, outside_extent, &kEverywhere).relief;
}

Relief ground_relief(const GroundSpec& ground, glm::vec2 p, std::uint32_t seed) {
  if (ground.surface == "paving") {
    const Paving stones = paving(p, seed, outside_extent, &ground.extent);
    if (stones.joint < 1.5F) return stones.relief;
    return simple_ground(ground.around, p, seed);
  }
  return simple_ground(outside_extent(p, &ground.extent) ? ground.around : ground.surface, p, seed);
}

}  // namespace app::synth
