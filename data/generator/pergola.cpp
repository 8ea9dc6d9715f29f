#include "data/generator/models.h"
#include "data/generator/outline.h"
#include "data/generator/solids.h"
#include "data/generator/textures.h"
#include "data/generator/timber.h"

namespace generator {
namespace {

const glm::vec3 kEast(1, 0, 0);
const glm::vec3 kNorth(0, 1, 0);
const glm::vec3 kUp(0, 0, 1);

constexpr float kPost = 0.12F;    // edge of a post
constexpr float kCorner = 1.32F;  // posts stand at (+-kCorner, +-kCorner)
constexpr float kFootHeight = 0.14F;
constexpr float kBeamBottom = 2.16F;
constexpr float kBeamHeight = 0.17F;
constexpr float kBeamThickness = 0.05F;
constexpr float kRafterBottom = 2.285F;  // notched over the beams
constexpr float kRafterHeight = 0.15F;
constexpr float kRafterThickness = 0.045F;
constexpr float kLath = 0.035F;
constexpr float kLathWidth = 0.062F;
constexpr float kLength = 3.2F;

void add_posts(Timber& timber) {
  for (const float x : {-kCorner, kCorner}) {
    for (const float y : {-kCorner, kCorner}) {
      timber.beam({x, y, kFootHeight - 0.01F}, {x, y, kBeamBottom + kBeamHeight - 0.012F}, kEast, {kPost, kPost},
                  0.010F);
    }
  }
}

void add_roof(Timber& timber, Random& random) {
  // Two beams clasp each pair of posts.
  for (const float y : {-kCorner, kCorner}) {
    for (const float side : {-1.0F, 1.0F}) {
      const float offset = 0.5F * (kPost + kBeamThickness);
      timber.shaped({0, y + side * offset, kBeamBottom + 0.5F * kBeamHeight}, kEast, kUp,
                    ogee_beam(kLength, kBeamHeight), kBeamThickness, 0.004F);
    }
  }
  constexpr int kRafters = 8;
  for (int i = 0; i < kRafters; ++i) {
    const float x = -1.4F + 2.8F * static_cast<float>(i) / (kRafters - 1) + random.uniform(-0.004F, 0.004F);
    timber.shaped({x, 0, kRafterBottom + 0.5F * kRafterHeight}, kNorth, kUp, ogee_beam(kLength, kRafterHeight),
                  kRafterThickness, 0.004F);
  }
  constexpr int kLaths = 19;
  const float bottom = kRafterBottom + kRafterHeight - 0.004F;
  for (int i = 0; i < kLaths; ++i) {
    const float y = -1.5F + 3.0F * static_cast<float>(i) / (kLaths - 1);
    const float z = bottom + 0.5F * kLath;
    const float east = 0.5F * kLength - random.uniform(0.0F, 0.012F);
    const float west = 0.5F * kLength - random.uniform(0.0F, 0.012F);
    const float turn = random.uniform(-0.006F, 0.006F);
    timber.beam({-west, y - turn, z}, {east, y + turn, z}, kNorth, {kLathWidth, kLath}, 0.004F);
  }
}

// Braces from each post up to the beams (along x) and to a rafter's plane (along y).
void add_braces(Timber& timber) {
  constexpr float kReach = 0.52F;
  for (const float x : {-kCorner, kCorner}) {
    for (const float y : {-kCorner, kCorner}) {
      const float in_x = x < 0 ? 1.0F : -1.0F;
      const float in_y = y < 0 ? 1.0F : -1.0F;
      const float top = kBeamBottom + 0.06F;
      timber.beam({x + in_x * 0.03F, y, top - kReach - 0.03F}, {x + in_x * (kReach + 0.06F), y, top}, kNorth,
                  {0.06F, 0.08F}, 0.006F);
      const float rafter = kRafterBottom + 0.05F;
      timber.beam({x, y + in_y * 0.03F, rafter - kReach - 0.03F}, {x, y + in_y * (kReach + 0.06F), rafter}, kEast,
                  {0.06F, 0.08F}, 0.006F);
    }
  }
}

// Laths between the west posts, fixed to two upright battens; open below, so that the wall seems to float.
void add_wall(Timber& timber, Random& random) {
  const float inner = kCorner - 0.5F * kPost;
  for (const float y : {-0.45F, 0.45F}) {
    timber.beam({-kCorner - 0.022F, y, 0.26F}, {-kCorner - 0.022F, y, 2.02F}, kNorth, {0.06F, 0.028F}, 0.004F);
  }
  constexpr int kLaths = 15;
  for (int i = 0; i < kLaths; ++i) {
    const float z = 0.34F + 0.115F * static_cast<float>(i);
    const float tilt = random.uniform(-0.0025F, 0.0025F);
    timber.beam({-kCorner + 0.003F, -inner - 0.02F, z - tilt}, {-kCorner + 0.003F, inner + 0.02F, z + tilt}, kEast,
                {0.024F, 0.075F}, 0.004F);
  }
}

void add_feet(render::Mesh& mesh, Random& random) {
  for (const float x : {-kCorner, kCorner}) {
    for (const float y : {-kCorner, kCorner}) {
      Mapping mapping;
      const glm::vec2 shift(random.uniform(0, 1), random.uniform(0, 1));
      mapping.uv_from_side = mapping.uv_from_cap = glm::mat3(2.5F, 0, 0, 0, 2.5F, 0, shift.x, shift.y, 1);
      const Frame frame{{x, y, 0.5F * kFootHeight}, glm::mat3(1.0F)};
      extrude(mesh, chamfered_rectangle({0.24F, 0.24F}, 0.014F), kFootHeight, 0.014F, frame, mapping);
    }
  }
}

// Coach bolts through beams and posts: flat domed heads.
void add_bolts(render::Mesh& mesh) {
  for (const float x : {-kCorner, kCorner}) {
    for (const float y : {-kCorner, kCorner}) {
      for (const float side : {-1.0F, 1.0F}) {
        for (const float dz : {-0.035F, 0.04F}) {
          const float face = y + side * (0.5F * kPost + kBeamThickness);
          const glm::vec3 at(x + dz * 0.6F, face, kBeamBottom + 0.5F * kBeamHeight + dz);
          const auto first = mesh.vertices.size();
          lathe(mesh, glm::vec3(0.0F), {{0.016F, -0.002F}, {0.016F, 0.003F}, {0.011F, 0.008F}, {0.0F, 0.010F}}, 12,
                0.1F);
          for (std::size_t i = first; i < mesh.vertices.size(); ++i) {  // z of the bolt points out of the beam
            const auto turned = [&](const glm::vec3& v) { return glm::vec3(-side * v.x, side * v.z, v.y); };
            mesh.vertices[i].position = at + turned(mesh.vertices[i].position);
            mesh.vertices[i].normal = turned(mesh.vertices[i].normal);
          }
        }
      }
    }
  }
}

}  // namespace

render::Model make_pergola() {
  render::Model model;
  model.name = "pergola";
  model.meshes.resize(3);
  Random random(11);
  Timber timber(model.meshes[0], 12);
  add_posts(timber);
  add_roof(timber, random);
  add_braces(timber);
  add_wall(timber, random);
  model.meshes[0].material = add_wood(model);
  add_feet(model.meshes[1], random);
  render::Material granite;
  granite.name = "granite";
  granite.metallic = 0.0F;
  granite.roughness = 0.8F;
  granite.base_color_texture.image = static_cast<int>(model.images.size());
  granite.normal_texture.image = granite.base_color_texture.image + 1;
  for (render::Image& image : granite_textures()) model.images.push_back(std::move(image));
  model.meshes[1].material = static_cast<int>(model.materials.size());
  model.materials.push_back(granite);
  add_bolts(model.meshes[2]);
  render::Material steel;
  steel.name = "steel";
  steel.base_color = glm::vec4(0.30F, 0.29F, 0.28F, 1.0F);
  steel.roughness = 0.45F;
  model.meshes[2].material = static_cast<int>(model.materials.size());
  model.materials.push_back(steel);
  return model;
}

}  // namespace generator
