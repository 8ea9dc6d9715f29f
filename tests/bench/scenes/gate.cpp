#include <cmath>

#include "data/generator/random.h"
#include "data/generator/textures.h"
#include "data/generator/timber.h"
#include "render/scene/mesh_tools.h"
#include "tests/bench/scenes/rough_block.h"
#include "tests/bench/scenes/scenes.h"

namespace bench_scenes {
namespace {

constexpr float kPi = 3.14159265F;
constexpr float kSpring = 2.5F;  // height at which the arch begins
constexpr float kRadius = 1.7F;  // of the arch's opening
constexpr float kFront = -0.6F;  // the wall from south to north
constexpr float kBack = 0.6F;
constexpr float kWallTop = 6.4F;
constexpr float kWallHalf = 3.4F;  // where the towers begin
constexpr float kCourse = 0.42F;   // height of a course of stones
constexpr float kTowerX = 4.6F;
constexpr float kTowerRadius = 1.7F;
constexpr float kTowerTop = 8.0F;

enum Part : std::size_t { Stone, Core, Cobbles, Iron, Wood, PartCount };

class Gate {
 public:
  Gate(render::Model& model, int stone_cells, int cobble_cells)
      : model_(model), stone_cells_(stone_cells), cobble_cells_(cobble_cells) {}

  void build() {
    wall();
    arch();
    for (const float x : {-kTowerX, kTowerX}) tower(x);
    merlons();
    portcullis();
    cobbles();
  }

 private:
  std::uint32_t seed() { return ++seed_; }

  void stone(const glm::vec3& centre, const glm::mat3& axes, const glm::vec3& size) {
    add_block(model_.meshes[Stone], {.centre = centre,
                                     .axes = axes,
                                     .size = size,
                                     .round = 0.035F,
                                     .bulge = 0.022F,
                                     .cells = stone_cells_,
                                     .seed = seed()});
  }

  // Half the width that a course from `low` to `high` leaves to the arch: it may reach under its voussoirs, which stand
  // proud of the wall, but not into the opening.
  static float opening(float low, float high) {
    const auto half = [](float radius, float z) {
      const float above = std::max(0.0F, z - kSpring);
      return above < radius ? std::sqrt(radius * radius - above * above) : 0.0F;
    };
    if (high <= kSpring) return kRadius;
    return std::max(half(kRadius + 0.45F, high), half(kRadius + 0.06F, low));
  }

  // A course of stones between two places, laid through the whole wall; `shift` moves the joints.
  void course(float from, float to, float z, float shift) {
    float x = from;
    while (x < to - 0.05F) {
      float length = random_.uniform(0.55F, 0.95F);
      if (x == from) length *= shift;
      if (x + length > to - 0.3F) length = to - x;
      stone({x + 0.5F * length, 0.0F, z}, glm::mat3(1.0F),
            {length - 0.012F, kBack - kFront + random_.uniform(-0.02F, 0.03F), kCourse - 0.012F});
      x += length;
    }
  }

  void wall() {
    int row = 0;
    for (float z = 0.5F * kCourse; z < kWallTop; z += kCourse, ++row) {
      const float shift = row % 2 == 0 ? 1.0F : 0.5F;
      const float half = opening(z - 0.5F * kCourse, z + 0.5F * kCourse);
      if (half <= 0.0F) {
        course(-kWallHalf, kWallHalf, z, shift);
      } else {
        course(-kWallHalf, -half, z, shift);
        course(half, kWallHalf, z, shift);
      }
    }
    core();
  }

  // What fills the joints, so that no light comes through them: strips from the opening outwards.
  void core() {
    constexpr float kInset = 0.12F;
    render::Mesh& mesh = model_.meshes[Core];
    constexpr float kStep = 0.1F;
    for (float z = 0.0F; z < kWallTop - kStep; z += kStep) {
      const float above = std::max(0.0F, z - kSpring);
      const float kClear = kRadius + 0.08F;
      const float half = above < kClear ? std::sqrt(kClear * kClear - above * above) : 0.0F;
      const float to = kWallHalf + 0.3F;
      add_box(mesh, {half, kFront + kInset, z}, {to, kBack - kInset, z + kStep + 0.01F}, 0.4F);
      add_box(mesh, {-to, kFront + kInset, z}, {-half, kBack - kInset, z + kStep + 0.01F}, 0.4F);
    }
  }

  // Wedge stones, a little proud of the wall, and a keystone.
  void arch() {
    constexpr int kStones = 17;
    const float middle = kRadius + 0.25F;
    const float length = kPi * middle / kStones;
    for (int i = 0; i < kStones; ++i) {
      const float a = kPi * (static_cast<float>(i) + 0.5F) / kStones;
      const glm::vec3 out(std::cos(a), 0.0F, std::sin(a));
      const glm::vec3 along(-std::sin(a), 0.0F, std::cos(a));
      const float proud = i == kStones / 2 ? 0.34F : 0.20F;
      stone(glm::vec3(0.0F, 0.0F, kSpring) + out * middle, glm::mat3(along, glm::vec3(0, 1, 0), -out),
            {length * 1.02F, kBack - kFront + proud, 0.52F});
    }
  }

  void tower(float x) {
    const glm::vec3 middle(x, 0.0F, 0.0F);
    int row = 0;
    for (float z = 0.5F * kCourse; z < kTowerTop; z += kCourse, ++row) {
      constexpr int kStones = 14;
      for (int i = 0; i < kStones; ++i) {
        const float a = 2.0F * kPi * (static_cast<float>(i) + (row % 2 == 0 ? 0.0F : 0.5F)) / kStones;
        const glm::vec3 out(std::cos(a), std::sin(a), 0.0F);
        const glm::vec3 along(-std::sin(a), std::cos(a), 0.0F);
        const float length = 2.0F * kPi * kTowerRadius / kStones;
        stone(middle + out * (kTowerRadius - 0.2F) + glm::vec3(0, 0, z), glm::mat3(along, -out, glm::vec3(0, 0, 1)),
              {length, 0.4F + random_.uniform(-0.01F, 0.03F), kCourse - 0.012F});
      }
    }
    constexpr float kInner = kTowerRadius - 0.24F;
    add_box(model_.meshes[Core], {x - 0.7F * kInner, -0.7F * kInner, 0.0F},
            {x + 0.7F * kInner, 0.7F * kInner, kTowerTop}, 0.4F);
    for (int i = 0; i < 7; ++i) {
      const float a = 2.0F * kPi * static_cast<float>(i) / 7.0F;
      const glm::vec3 out(std::cos(a), std::sin(a), 0.0F);
      stone(middle + out * (kTowerRadius - 0.16F) + glm::vec3(0, 0, kTowerTop + 0.38F),
            glm::mat3(glm::vec3(-std::sin(a), std::cos(a), 0.0F), -out, glm::vec3(0, 0, 1)), {0.75F, 0.45F, 0.75F});
    }
  }

  void merlons() {
    for (int i = -2; i <= 2; ++i) {
      stone({1.25F * static_cast<float>(i), -0.35F, kWallTop + 0.35F}, glm::mat3(1.0F), {0.75F, 0.5F, 0.8F});
    }
  }

  // Iron-shod bars, drawn up so far that a rider passes under it.
  void portcullis() {
    constexpr float kLow = 2.05F;
    generator::Timber bars(model_.meshes[Wood], 17);
    for (int i = -5; i <= 5; ++i) {
      const float x = 0.31F * static_cast<float>(i);
      const float top = kSpring + std::sqrt(std::max(0.0F, kRadius * kRadius - x * x)) + 0.3F;
      bars.beam({x, 0.0F, kLow}, {x, 0.0F, top}, {1, 0, 0}, {0.085F, 0.085F}, 0.012F);
      spike({x, 0.0F, kLow});
    }
    for (float z = kLow + 0.25F; z < kSpring + kRadius; z += 0.36F) {
      const float half = z < kSpring ? kRadius : std::sqrt(kRadius * kRadius - (z - kSpring) * (z - kSpring));
      bars.beam({-half - 0.1F, 0.012F, z}, {half + 0.1F, 0.012F, z}, {0, 0, 1}, {0.075F, 0.075F}, 0.01F);
    }
  }

  void spike(const glm::vec3& top) {
    render::Mesh& mesh = model_.meshes[Iron];
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    constexpr float kHalf = 0.05F;
    const glm::vec3 tip = top - glm::vec3(0, 0, 0.24F);
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
      mesh.vertices.push_back({top + kHalf * glm::vec3(corner, 0.6F), {0, 0, 1}, glm::vec4(0.0F), corner});
    }
    mesh.vertices.push_back({tip, {0, 0, -1}, glm::vec4(0.0F), {0, 0}});
    for (std::uint32_t i = 0; i < 4; ++i) {
      mesh.indices.insert(mesh.indices.end(), {first + i, first + 4, first + (i + 1) % 4});
    }
  }

  // Rows of worn stones on the way, set in earth.
  void cobbles() {
    add_box(model_.meshes[Core], {-14.0F, -15.0F, -0.5F}, {14.0F, 15.0F, -0.02F}, 0.4F);
    for (float y = -11.6F; y < 7.5F; y += 0.58F) {
      float x = -2.7F + random_.uniform(0.0F, 0.4F);
      while (x < 2.5F) {
        const float width = random_.uniform(0.45F, 0.75F);
        const float turn = random_.uniform(-0.05F, 0.05F);
        const glm::mat3 axes(glm::vec3(std::cos(turn), std::sin(turn), 0),
                             glm::vec3(-std::sin(turn), std::cos(turn), 0),
                             glm::vec3(random_.uniform(-0.03F, 0.03F), random_.uniform(-0.03F, 0.03F), 1));
        add_block(model_.meshes[Cobbles], {.centre = {x + 0.5F * width, y, -0.09F},
                                           .axes = axes,
                                           .size = {width - 0.02F, 0.56F, 0.24F},
                                           .round = 0.07F,
                                           .bulge = 0.025F,
                                           .cells = cobble_cells_,
                                           .seed = seed()});
        x += width;
      }
    }
  }

  render::Model& model_;
  int stone_cells_;
  int cobble_cells_;
  generator::Random random_{21};
  std::uint32_t seed_ = 100;
};

}  // namespace

render::Model make_gate(Detail detail) {
  render::Model model;
  model.name = detail == Detail::Coarse ? "gate-66k" : "gate-188k";
  model.meshes.resize(PartCount);
  const bool coarse = detail == Detail::Coarse;
  Gate(model, coarse ? 2 : 4, coarse ? 3 : 4).build();
  render::make_flat_normals(model.meshes[Iron]);
  model.meshes[Stone].material = add_material(model, "ashlar", generator::granite_textures(), 0.9F);
  model.materials.back().base_color = {0.95F, 0.86F, 0.70F, 1.0F};
  model.meshes[Core].material = add_material(model, "mortar", generator::soil_textures(), 1.0F);
  model.meshes[Cobbles].material = add_material(model, "cobbles", generator::granite_textures(), 0.75F);
  model.materials.back().base_color = {0.62F, 0.60F, 0.58F, 1.0F};
  model.meshes[Iron].material = add_material(model, "iron", glm::vec3(0.05F, 0.048F, 0.045F), 0.6F);
  model.meshes[Wood].material = generator::add_wood(model);
  model.materials.back().base_color = {0.35F, 0.30F, 0.26F, 1.0F};
  render::update_bounds(model);
  return model;
}

std::string gate_yaml(const std::string& model) {
  return "# A castle gate against the morning sun, in thin mist without bounds.\n"
         "skyshaft: 1\n"
         "sky: { model: perez, turbidity: 3 }\n"
         "medium: { extinction: 0.025, albedo: 0.95, phase: hg, g: 0.6 }\n"
         "objects: [ { model: " +
         model +
         ".glb } ]\n"
         "exposure: { white_luminance: 34000 }\n"
         "view: { eye: [2.1, -10.8, 1.5], target: [-0.35, 0, 2.7], vertical_fov_deg: 46 }\n"
         "sun: { azimuth_deg: 343, elevation_deg: 26, illuminance_lux: 260000, color: [1, 0.9, 0.74], "
         "angular_radius_deg: 0 }\n";
}

}  // namespace bench_scenes
