#include "app/synth/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "app/synth/noise.h"
#include "app/synth/parallel.h"

namespace app::synth {

namespace {

// One place of a surface before its relief is turned into slopes and shade.
struct Relief {
  glm::vec3 albedo{0.5F};
  float height_m = 0.0F;
  float gloss = 0.0F;
};

Relief blend(const Relief& a, const Relief& b, float t) {
  return {glm::mix(a.albedo, b.albedo, t), glm::mix(a.height_m, b.height_m, t), glm::mix(a.gloss, b.gloss, t)};
}

// Nearest stone of an irregular pattern: jittered grid points (Worley 1996), distance to the border after Quilez.
struct Stone {
  glm::ivec2 cell{0};
  glm::vec2 centre{0.0F};
  float border = 0.0F;  // distance to the nearest edge, in cells
};

glm::vec2 stone_point(glm::ivec2 cell, std::uint32_t seed) {
  const std::uint32_t h = hash_cell(cell.x, cell.y, seed);
  return glm::vec2(cell) + 0.5F + 0.86F * (glm::vec2(unit_float(h), unit_float(mix_bits(h))) - 0.5F);
}

// The points of the cells about one cell. Neighbouring texels mostly ask for the same ones.
struct StonePoints {
  glm::ivec2 home{0};
  std::uint32_t seed = 0;
  bool known = false;
  std::array<glm::vec2, 25> points;

  void look_up(glm::ivec2 cell, std::uint32_t cell_seed) {
    if (known && home == cell && seed == cell_seed) return;
    home = cell;
    seed = cell_seed;
    known = true;
    for (int i = 0; i < 25; ++i)
      points[static_cast<std::size_t>(i)] = stone_point(cell + glm::ivec2(i % 5 - 2, i / 5 - 2), cell_seed);
  }
};

Stone find_stone(glm::vec2 p, std::uint32_t seed) {
  thread_local StonePoints about;
  const glm::ivec2 home(floor_of(p.x), floor_of(p.y));
  about.look_up(home, seed);
  int nearest = 0;
  float nearest2 = 1e9F;
  for (int i = 0; i < 25; ++i) {
    const glm::vec2 to = about.points[static_cast<std::size_t>(i)] - p;
    const float d2 = glm::dot(to, to);
    if (d2 < nearest2) {
      nearest2 = d2;
      nearest = i;
    }
  }
  Stone stone;
  stone.cell = home + glm::ivec2(nearest % 5 - 2, nearest / 5 - 2);
  stone.centre = about.points[static_cast<std::size_t>(nearest)];
  stone.border = 1e9F;
  for (int i = 0; i < 25; ++i) {
    if (i == nearest) continue;
    const glm::vec2 q = about.points[static_cast<std::size_t>(i)];
    const glm::vec2 across = q - stone.centre;
    const float to_middle = glm::dot(0.5F * (q + stone.centre) - p, across);  // times the length of `across`
    const float length2 = glm::dot(across, across);
    if (to_middle * to_middle < stone.border * stone.border * length2)
      stone.border = std::max(to_middle, 0.0F) / std::sqrt(length2);
  }
  return stone;
}

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

// The colours of one quarry's limestone: buff, honey, grey, rose, each stone with its own mix.
glm::vec3 stone_colour(std::uint32_t h) {
  static const std::array<glm::vec3, 6> kPalette{glm::vec3(0.43F, 0.37F, 0.29F),   glm::vec3(0.39F, 0.32F, 0.235F),
                                                 glm::vec3(0.35F, 0.325F, 0.285F), glm::vec3(0.44F, 0.395F, 0.33F),
                                                 glm::vec3(0.38F, 0.30F, 0.24F),   glm::vec3(0.31F, 0.285F, 0.25F)};
  const auto first = static_cast<std::size_t>(unit_float(h) * 5.999F);
  const auto second = static_cast<std::size_t>(unit_float(mix_bits(h + 1U)) * 5.999F);
  return glm::mix(kPalette[first], kPalette[second], 0.5F * unit_float(mix_bits(h + 2U)));
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

Relief box_relief(const std::string& surface, glm::vec2 p, std::uint32_t seed) {
  if (surface == "brick") return brick(p, seed);
  if (surface == "stone") return rubble(p, seed);
  if (surface == "plaster") return plaster(p, seed);
  if (surface == "terracotta") return terracotta(p, seed);
  if (surface == "wood") return wood(p, seed);
  if (surface == "concrete") return concrete(p, seed);
  throw std::invalid_argument("no such box surface: " + surface);
}

bool outside_extent(glm::vec2 centre, const void* user) {
  const auto& e = *static_cast<const std::array<double, 4>*>(user);
  return centre.x < e[0] || centre.x > e[2] || centre.y < e[1] || centre.y > e[3];
}

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
