#include "app/synth/plant_growth.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "app/synth/noise.h"

namespace app::synth {
namespace {

glm::vec3 any_direction(Random& random) {
  const float z = random.between(-1.0F, 1.0F);
  const float turn = random.between(0.0F, 2.0F * std::numbers::pi_v<float>);
  const float r = std::sqrt(std::max(0.0F, 1.0F - z * z));
  return {r * std::cos(turn), r * std::sin(turn), z};
}

struct Foliage {
  float length_m, width_m;
  glm::vec3 albedo, through;
  float colour_spread;
};

Leaf make_leaf(const glm::vec3& place, const glm::vec3& bias, const Foliage& kind, Random& random) {
  Leaf leaf;
  leaf.place = place;
  const glm::vec3 along = glm::normalize(bias + any_direction(random));
  leaf.along = along * (0.5F * kind.length_m * random.between(0.7F, 1.3F));
  leaf.half_width_m = 0.5F * kind.width_m * random.between(0.7F, 1.3F);
  leaf.normal = glm::normalize(glm::cross(along, any_direction(random)) + 1e-4F);
  const float tone = 1.0F + kind.colour_spread * random.bell();
  const float yellow = 1.0F + 0.25F * kind.colour_spread * random.bell();
  leaf.albedo = glm::max(kind.albedo * tone * glm::vec3(yellow, 1.0F, 1.0F), glm::vec3(0.005F));
  leaf.through = glm::max(kind.through * tone * glm::vec3(yellow, 1.0F, 1.0F), glm::vec3(0.0F));
  return leaf;
}

// Wood as a chain of short pieces that taper.
void grow_wood(std::vector<Leaf>& leaves, glm::vec3 from, glm::vec3 to, float radius_from, float radius_to,
               Random& random) {
  const float length = glm::length(to - from);
  const int pieces = std::max(3, static_cast<int>(length / 0.05F));
  glm::vec3 bend(random.bell(), random.bell(), 0.0F);
  for (int i = 0; i < pieces; ++i) {
    const float t = (static_cast<float>(i) + 0.5F) / static_cast<float>(pieces);
    const float radius = glm::mix(radius_from, radius_to, t);
    for (int k = 0; k < 7; ++k) {  // strips of bark around the stem
      const float turn = 2.0F * std::numbers::pi_v<float> * (static_cast<float>(k) + 0.3F * random.next()) / 7.0F;
      Leaf piece;
      piece.normal = {std::cos(turn), std::sin(turn), 0.15F};
      piece.place = glm::mix(from, to, t) + bend * (0.05F * length * std::sin(std::numbers::pi_v<float> * t)) +
                    0.75F * radius * piece.normal;
      piece.along = (to - from) * (0.8F / static_cast<float>(pieces));
      piece.half_width_m = 0.55F * radius;
      piece.albedo = glm::vec3(0.17F, 0.14F, 0.11F) * random.between(0.6F, 1.25F);
      leaves.push_back(piece);
    }
  }
}

std::vector<Leaf> grow_cypress(const PlantSpec& plant, Random& random) {
  const auto height = static_cast<float>(plant.height_m);
  const auto half = 0.5F * static_cast<float>(plant.width_m);
  const Foliage kind{0.11F, 0.030F, {0.040F, 0.062F, 0.024F}, {0.012F, 0.022F, 0.004F}, 0.28F};
  std::vector<Leaf> leaves;
  const int count = static_cast<int>(9000.0F * height * half / 1.2F) + 4000;
  for (int i = 0; i < count; ++i) {
    const float t = std::pow(random.next(), 0.9F);
    const float turn = random.between(0.0F, 2.0F * std::numbers::pi_v<float>);
    const float profile = std::pow(std::max(1.0F - t, 0.0F), 0.55F) * smooth_ramp(-0.12F, 0.16F, t);
    const float flame = 0.78F + 0.44F * fractal_noise({turn * 2.2F + 9.0F, t * height * 1.6F}, 4, 77U);
    const float r = half * profile * flame * std::sqrt(random.between(0.35F, 1.0F));
    const glm::vec3 out(std::cos(turn), std::sin(turn), 0.0F);
    leaves.push_back(make_leaf(out * r + glm::vec3(0.0F, 0.0F, 0.15F + t * (height - 0.2F)),
                               glm::vec3(0.6F * out.x, 0.6F * out.y, 1.9F), kind, random));
  }
  grow_wood(leaves, {0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.3F * height}, 0.06F * half + 0.05F, 0.05F, random);
  return leaves;
}

std::vector<Leaf> grow_tree(const PlantSpec& plant, const Foliage& kind, float trunk_share, Random& random) {
  const auto height = static_cast<float>(plant.height_m);
  const auto half = 0.5F * static_cast<float>(plant.width_m);
  std::vector<Leaf> leaves;
  const float crown_low = trunk_share * height;
  const glm::vec3 fork(0.04F * half * random.bell(), 0.04F * half * random.bell(), crown_low * 0.9F);
  grow_wood(leaves, glm::vec3(0.0F), fork, 0.035F * height, 0.026F * height, random);
  const int clusters = 26 + static_cast<int>(6.0F * half);
  for (int c = 0; c < clusters; ++c) {
    const glm::vec3 d = any_direction(random);
    const float reach = std::pow(random.between(0.15F, 1.0F), 0.45F);
    const glm::vec3 middle(d.x * half * reach * 0.80F, d.y * half * reach * 0.80F,
                           crown_low + 0.5F * (height - crown_low) * (1.0F + d.z * reach * 0.82F));
    const float radius = random.between(0.20F, 0.36F) * half;
    grow_wood(leaves, fork, middle, 0.016F * height, 0.004F * height, random);
    const int count =
        static_cast<int>(2300.0F * radius * radius / (kind.length_m * 8.0F * kind.width_m * 4.0F) * 0.02F) + 320;
    for (int i = 0; i < count; ++i) {
      const glm::vec3 at = any_direction(random) * std::cbrt(random.between(0.08F, 1.0F)) * radius;
      const glm::vec3 place = middle + at * glm::vec3(1.0F, 1.0F, 0.78F);
      leaves.push_back(make_leaf(place, glm::normalize(at + 1e-3F) + glm::vec3(0.0F, 0.0F, -0.35F), kind, random));
    }
  }
  return leaves;
}

// A clump of upright stems: grass, or lavender with its flower spikes.
std::vector<Leaf> grow_clump(const PlantSpec& plant, bool flowers, Random& random) {
  const auto height = static_cast<float>(plant.height_m);
  const auto half = 0.5F * static_cast<float>(plant.width_m);
  const Foliage green{0.5F * height, flowers ? 0.007F : 0.009F, {0.085F, 0.115F, 0.055F}, {0.06F, 0.09F, 0.02F}, 0.3F};
  const Foliage spike{0.035F, 0.016F, {0.125F, 0.085F, 0.24F}, {0.06F, 0.03F, 0.11F}, 0.3F};
  std::vector<Leaf> leaves;
  const int stems = static_cast<int>(420.0F + 1500.0F * half);
  for (int i = 0; i < stems; ++i) {
    const float turn = random.between(0.0F, 2.0F * std::numbers::pi_v<float>);
    const float r = std::sqrt(random.next());
    const glm::vec3 out(std::cos(turn), std::sin(turn), 0.0F);
    const glm::vec3 foot = out * (0.45F * half * r);
    const float tall = height * random.between(0.62F, 1.0F) * (1.0F - 0.25F * r * r);
    const glm::vec3 tip =
        foot + out * (0.62F * half * r) + glm::vec3(0.05F * half * random.bell(), 0.05F * half * random.bell(), tall);
    const int pieces = 7;
    for (int k = 0; k < pieces; ++k) {
      const float t = (static_cast<float>(k) + 0.5F) / pieces;
      Leaf leaf = make_leaf({}, {0.0F, 0.0F, 3.0F}, green, random);
      const float lean = t * t;
      leaf.place = {glm::mix(foot.x, tip.x, lean), glm::mix(foot.y, tip.y, lean), t * tip.z};
      leaf.along = glm::normalize(glm::vec3((tip.x - foot.x) * 2.0F * t, (tip.y - foot.y) * 2.0F * t, tip.z)) *
                   (0.62F * tall / pieces);
      leaf.half_width_m *= 1.1F - 0.7F * t;
      leaves.push_back(leaf);
    }
    if (!flowers || random.next() < 0.25F) continue;
    for (int k = 0; k < 9; ++k) {
      const float up = 0.011F * static_cast<float>(k);
      leaves.push_back(make_leaf(tip + glm::vec3(0.004F * random.bell(), 0.004F * random.bell(), up),
                                 {0.0F, 0.0F, 1.6F}, spike, random));
    }
  }
  return leaves;
}

// A clipped hedge, `width_m` long across the view and a third of its height deep.
std::vector<Leaf> grow_hedge(const PlantSpec& plant, const glm::vec2& right, Random& random) {
  const auto height = static_cast<float>(plant.height_m);
  const auto width = static_cast<float>(plant.width_m);
  const glm::vec3 side(right, 0.0F);
  const glm::vec3 deep(-right.y, right.x, 0.0F);
  const Foliage kind{0.055F, 0.030F, {0.060F, 0.095F, 0.028F}, {0.035F, 0.060F, 0.008F}, 0.32F};
  std::vector<Leaf> leaves;
  const int count = static_cast<int>(8200.0F * width * height);
  for (int i = 0; i < count; ++i) {
    const float x = random.between(-0.5F, 0.5F) * width;
    const float top = height * (0.93F + 0.10F * fractal_noise({x * 2.1F, 3.0F}, 4, 91U));
    const float z = top * std::pow(random.next(), 0.75F);
    const float y = 0.17F * height * (random.next() - 0.5F) * (1.2F - 0.2F * z / height);
    leaves.push_back(make_leaf(side * x + deep * y + glm::vec3(0.0F, 0.0F, z + 0.012F * random.bell()),
                               {0.0F, 0.0F, 0.4F}, kind, random));
  }
  return leaves;
}

}  // namespace

std::vector<Leaf> grow(const PlantSpec& plant, const glm::vec2& right, std::uint32_t seed) {
  Random random(seed);
  if (plant.kind == "cypress") return grow_cypress(plant, random);
  if (plant.kind == "olive")
    return grow_tree(plant, {0.07F, 0.016F, {0.135F, 0.155F, 0.095F}, {0.045F, 0.06F, 0.015F}, 0.30F}, 0.30F, random);
  if (plant.kind == "tree")
    return grow_tree(plant, {0.10F, 0.060F, {0.070F, 0.115F, 0.032F}, {0.075F, 0.120F, 0.014F}, 0.28F}, 0.26F, random);
  if (plant.kind == "shrub")
    return grow_tree(plant, {0.05F, 0.030F, {0.075F, 0.115F, 0.036F}, {0.060F, 0.100F, 0.014F}, 0.30F}, 0.06F, random);
  if (plant.kind == "lavender") return grow_clump(plant, true, random);
  if (plant.kind == "grass") return grow_clump(plant, false, random);
  if (plant.kind == "hedge") return grow_hedge(plant, right, random);
  throw std::invalid_argument("no such plant: " + plant.kind);
}

}  // namespace app::synth
