#include <cmath>

#include "data/generator/models.h"
#include "data/generator/random.h"
#include "data/generator/solids.h"
#include "data/generator/textures.h"

namespace generator {
namespace {

const glm::vec3 kUp(0, 0, 1);
const glm::vec3 kCrown(0, 0, 1.06F);  // the crown's centre
constexpr float kCrownRadius = 0.40F;
constexpr float kPotHeight = 0.40F;
constexpr float kSoilHeight = 0.355F;

enum MeshIndex : std::size_t { Pot, Soil, Bark, Leaves, Fruit, MeshCount };

void add_pot(render::Mesh& pot, render::Mesh& soil) {
  const std::vector<glm::vec2> profile = {{0.000F, 0.000F}, {0.135F, 0.000F}, {0.143F, 0.006F}, {0.150F, 0.040F},
                                          {0.172F, 0.160F}, {0.191F, 0.270F}, {0.199F, 0.318F}, {0.204F, 0.322F},
                                          {0.217F, 0.324F}, {0.222F, 0.331F}, {0.226F, 0.385F}, {0.223F, 0.396F},
                                          {0.214F, 0.400F}, {0.203F, 0.398F}, {0.197F, 0.391F}, {0.191F, 0.330F}};
  lathe(pot, glm::vec3(0.0F), profile, 40, 0.5F);
  // The soil is heaped a little around the stem.
  lathe(soil, glm::vec3(0.0F),
        {{0.196F, kSoilHeight - 0.012F},
         {0.15F, kSoilHeight},
         {0.09F, kSoilHeight + 0.012F},
         {0.0F, kSoilHeight + 0.020F}},
        24, 0.3F);
}

struct Twig {
  glm::vec3 end;
  glm::vec3 direction;
};

// A bent branch; returns its end.
Twig add_branch(render::Mesh& bark, Random& random, const glm::vec3& from, const glm::vec3& towards, float radius,
                int sides) {
  constexpr int kSteps = 5;
  std::vector<glm::vec3> points{from};
  std::vector<float> radii{radius};
  glm::vec3 bend = random.on_sphere() * 0.10F * glm::distance(from, towards);
  for (int i = 1; i <= kSteps; ++i) {
    const float t = static_cast<float>(i) / kSteps;
    points.push_back(glm::mix(from, towards, t) + bend * std::sin(3.14159F * t) + kUp * (-0.05F * t * (1.0F - t)));
    radii.push_back(i == kSteps ? 0.0F : radius * glm::mix(1.0F, 0.45F, t));
  }
  tube(bark, points, radii, sides, 0.25F);
  return {points.back(), glm::normalize(points.back() - points[kSteps - 1])};
}

void add_stem(render::Mesh& bark) {
  const std::vector<glm::vec3> points = {
      {0.0F, 0.0F, kSoilHeight - 0.02F}, {0.002F, 0.0F, 0.41F}, {0.010F, 0.004F, 0.50F}, {0.004F, 0.012F, 0.60F},
      {-0.008F, 0.008F, 0.70F},          {0.0F, 0.0F, 0.82F},   {0.006F, -0.004F, 0.95F}};
  tube(bark, points, {0.034F, 0.025F, 0.022F, 0.021F, 0.020F, 0.019F, 0.0F}, 10, 0.25F);
}

void add_sprig(render::Mesh& leaves, Random& random, const glm::vec3& foot, const glm::vec3& direction) {
  const glm::vec3 outward = glm::normalize(foot - kCrown + kUp * 0.12F);
  const glm::vec3 along = glm::normalize(direction + 0.9F * random.on_sphere() + 0.15F * kUp);
  glm::vec3 facing = outward + 0.50F * random.on_sphere() + 0.45F * kUp;
  facing = glm::normalize(facing - along * glm::dot(facing, along));
  const std::uint32_t quarter = random.below(4);
  const std::uint32_t column = quarter % 2;
  const std::uint32_t row = quarter / 2;
  leaf_card(leaves, {foot,
                     along,
                     facing,
                     outward,
                     random.uniform(0.135F, 0.20F),
                     {0.5F * static_cast<float>(column), 0.5F * static_cast<float>(row)},
                     0.5F});
}

// Branches grow to points spread evenly over the crown [golden spiral]; sprigs sit along and at the end of each.
void add_crown(render::Model& model, Random& random) {
  constexpr int kBranches = 46;
  for (int i = 0; i < kBranches; ++i) {
    const float z = 1.0F - 1.72F * (static_cast<float>(i) + 0.5F) / kBranches;
    const float a = 2.39996F * static_cast<float>(i);
    const float r = std::sqrt(1.0F - z * z);
    const glm::vec3 sphere(r * std::cos(a), r * std::sin(a), z);
    const float reach = kCrownRadius * random.uniform(0.72F, 0.95F);
    const glm::vec3 tip = kCrown + sphere * glm::vec3(reach, reach, reach * 0.95F);
    const float root_height = glm::clamp(0.80F + 0.22F * (z + 0.4F), 0.74F, 0.95F);
    const glm::vec3 root(0.0F, 0.0F, root_height);
    const Twig twig = add_branch(model.meshes[Bark], random, root, tip, i % 4 == 0 ? 0.010F : 0.006F, 5);
    constexpr int kSprigs = 11;
    for (int k = 0; k < kSprigs; ++k) {
      const float t = glm::mix(0.45F, 1.0F, static_cast<float>(k) / (kSprigs - 1));
      const glm::vec3 foot = glm::mix(root, twig.end, t) + 0.035F * random.on_sphere();
      add_sprig(model.meshes[Leaves], random, foot,
                k + 1 == kSprigs ? twig.direction : glm::normalize(sphere + random.on_sphere()));
    }
  }
}

void add_lemons(render::Mesh& fruit, Random& random) {
  constexpr int kLemons = 15;
  for (int i = 0; i < kLemons; ++i) {
    const float z = 0.55F - 1.25F * (static_cast<float>(i) + 0.5F) / kLemons;
    const float a = 2.39996F * static_cast<float>(i) + 0.6F;
    const float r = std::sqrt(1.0F - z * z);
    const glm::vec3 sphere(r * std::cos(a), r * std::sin(a), z);
    const glm::vec3 axis = glm::normalize(glm::vec3(0, 0, -1) + 0.45F * random.on_sphere());
    lemon(fruit, kCrown + sphere * (kCrownRadius * random.uniform(0.88F, 1.03F)) - kUp * 0.03F, axis,
          random.uniform(0.027F, 0.033F), 10, 14);
  }
}

int add_material(render::Model& model, const char* name, std::vector<render::Image> images, float roughness) {
  render::Material material;
  material.name = name;
  material.metallic = 0.0F;
  material.roughness = roughness;
  const auto first = static_cast<int>(model.images.size());
  if (!images.empty()) material.base_color_texture.image = first;
  if (images.size() > 1) material.normal_texture.image = first + 1;
  for (render::Image& image : images) model.images.push_back(std::move(image));
  model.materials.push_back(material);
  return static_cast<int>(model.materials.size()) - 1;
}

}  // namespace

render::Model make_plant() {
  render::Model model;
  model.name = "plant";
  model.meshes.resize(MeshCount);
  Random random(5);
  add_pot(model.meshes[Pot], model.meshes[Soil]);
  add_stem(model.meshes[Bark]);
  add_crown(model, random);
  add_lemons(model.meshes[Fruit], random);
  model.meshes[Pot].material = add_material(model, "terracotta", terracotta_textures(), 0.85F);
  model.meshes[Soil].material = add_material(model, "soil", soil_textures(), 1.0F);
  model.meshes[Bark].material = add_material(model, "bark", bark_textures(), 0.9F);
  model.meshes[Leaves].material = add_material(model, "leaves", {leaf_texture()}, 0.5F);
  model.materials.back().alpha_mode = render::AlphaMode::Mask;
  model.materials.back().double_sided = true;
  model.meshes[Fruit].material = add_material(model, "lemon", {}, 0.42F);
  model.materials.back().base_color = glm::vec4(0.84F, 0.56F, 0.030F, 1.0F);
  return model;
}

}  // namespace generator
