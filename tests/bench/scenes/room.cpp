#include <array>

#include "data/generator/random.h"
#include "data/generator/textures.h"
#include "data/generator/timber.h"
#include "render/scene/mesh_tools.h"
#include "tests/bench/scenes/rough_block.h"
#include "tests/bench/scenes/scenes.h"

namespace bench_scenes {
namespace {

constexpr float kWest = -3.0F;  // the room inside
constexpr float kEast = 3.0F;
constexpr float kSouth = -2.5F;
constexpr float kNorth = 3.0F;
constexpr float kTop = 3.0F;
constexpr float kWall = 0.35F;
constexpr float kSill = 0.75F;
constexpr float kHead = 2.55F;
constexpr std::array<float, 2> kWindows{-1.35F, 1.35F};  // their middles
constexpr float kWindowHalf = 0.62F;

enum Part : std::size_t { Plaster, Wood, Garden, PartCount };

void add_walls(render::Mesh& mesh) {
  const float w = kWall;
  const auto box = [&](const glm::vec3& low, const glm::vec3& high) { add_box(mesh, low, high, 2.0F); };
  box({kWest - w, kSouth - w, kTop}, {kEast + w, kNorth + w, kTop + w});
  box({kWest - w, kSouth - w, -w}, {kEast + w, kNorth + w, -0.03F});
  box({kWest - w, kSouth - w, -w}, {kWest, kNorth + w, kTop + w});
  box({kEast, kSouth - w, -w}, {kEast + w, kNorth + w, kTop + w});
  box({kWest - w, kNorth, -w}, {kEast + w, kNorth + w, kTop + w});
  // The south wall: below, above, and the three piers about the windows.
  const float s = kSouth;
  box({kWest - w, s - w, -w}, {kEast + w, s, kSill});
  box({kWest - w, s - w, kHead}, {kEast + w, s, kTop + w});
  box({kWest - w, s - w, kSill}, {kWindows[0] - kWindowHalf, s, kHead});
  box({kWindows[0] + kWindowHalf, s - w, kSill}, {kWindows[1] - kWindowHalf, s, kHead});
  box({kWindows[1] + kWindowHalf, s - w, kSill}, {kEast + w, s, kHead});
}

// Frame and glazing bars: two by four panes.
void add_window(generator::Timber& timber, float middle) {
  const float y = kSouth - 0.5F * kWall;
  const glm::vec3 east(1, 0, 0);
  const glm::vec3 up(0, 0, 1);
  for (const float x : {middle - kWindowHalf + 0.035F, middle + kWindowHalf - 0.035F}) {
    timber.beam({x, y, kSill}, {x, y, kHead}, east, {0.07F, 0.08F}, 0.006F);
  }
  for (const float z : {kSill + 0.035F, kHead - 0.035F}) {
    timber.beam({middle - kWindowHalf, y, z}, {middle + kWindowHalf, y, z}, up, {0.07F, 0.08F}, 0.006F);
  }
  timber.beam({middle, y, kSill}, {middle, y, kHead}, east, {0.05F, 0.06F}, 0.006F);
  for (int i = 1; i < 4; ++i) {
    const float z = kSill + (kHead - kSill) * static_cast<float>(i) / 4.0F;
    timber.beam({middle - kWindowHalf, y, z}, {middle + kWindowHalf, y, z}, up, {0.032F, 0.05F}, 0.004F);
  }
}

void add_floor(generator::Timber& timber) {
  constexpr float kBoard = 0.16F;
  for (float x = kWest + 0.5F * kBoard; x < kEast; x += kBoard) {
    timber.beam({x, kSouth, -0.02F}, {x, kNorth, -0.02F}, {1, 0, 0}, {kBoard - 0.003F, 0.04F}, 0.003F);
  }
}

// A table, or a bench: a top of planks on four legs.
void add_trestle(generator::Timber& timber, const glm::vec3& middle, const glm::vec3& size) {
  constexpr int kPlanks = 4;
  const float width = size.y / kPlanks;
  for (int i = 0; i < kPlanks; ++i) {
    const float y = middle.y + (static_cast<float>(i) - 1.5F) * width;
    timber.beam({middle.x - 0.5F * size.x, y, size.z - 0.02F}, {middle.x + 0.5F * size.x, y, size.z - 0.02F}, {0, 1, 0},
                {width - 0.004F, 0.04F}, 0.004F);
  }
  for (const float sx : {-0.42F, 0.42F}) {
    for (const float sy : {-0.36F, 0.36F}) {
      const glm::vec3 foot(middle.x + sx * size.x, middle.y + sy * size.y, 0.0F);
      timber.beam(foot, foot + glm::vec3(0, 0, size.z - 0.04F), {1, 0, 0}, {0.07F, 0.07F}, 0.006F);
    }
    timber.beam({middle.x + sx * size.x, middle.y - 0.4F * size.y, size.z - 0.09F},
                {middle.x + sx * size.x, middle.y + 0.4F * size.y, size.z - 0.09F}, {1, 0, 0}, {0.05F, 0.09F}, 0.004F);
  }
}

}  // namespace

render::Model make_room() {
  render::Model model;
  model.name = "room";
  model.meshes.resize(PartCount);
  add_walls(model.meshes[Plaster]);
  generator::Timber timber(model.meshes[Wood], 41);
  for (const float window : kWindows) add_window(timber, window);
  add_floor(timber);
  add_trestle(timber, {0.5F, 0.9F, 0.0F}, {1.9F, 0.85F, 0.76F});
  add_trestle(timber, {0.4F, 0.05F, 0.0F}, {1.7F, 0.3F, 0.45F});
  add_trestle(timber, {0.6F, 1.75F, 0.0F}, {1.7F, 0.3F, 0.45F});
  // What one sees through the windows, too low to shade them.
  add_box(model.meshes[Garden], {-9.0F, kSouth - 4.5F, -1.0F}, {9.0F, kSouth - 4.4F, 3.1F}, 1.0F);
  // There is no light from wall to wall in the renderer: a faint glow stands for it.
  model.meshes[Plaster].material = add_material(model, "plaster", glm::vec3(0.72F, 0.68F, 0.60F), 0.95F);
  model.materials.back().emissive = glm::vec3(0.020F, 0.018F, 0.015F);
  model.meshes[Wood].material = generator::add_wood(model);
  model.materials.back().emissive = glm::vec3(0.006F, 0.005F, 0.004F);
  model.meshes[Garden].material = add_material(model, "garden", glm::vec3(0.0F), 1.0F);
  model.materials.back().emissive = glm::vec3(0.55F, 0.72F, 0.80F);
  render::update_bounds(model);
  return model;
}

std::string room_yaml(const std::string& model) {
  return "# A dusty room with two windows. No sky: what little of it came in through the windows is painted on.\n"
         "skyshaft: 1\n"
         "sky: none\n"
         "medium: { extinction: 0.09, albedo: 0.9, phase: hg, g: 0.5, extent: { box: [[-3, -2.5, 0], [3, 3, 3]] } }\n"
         "objects: [ { model: " +
         model +
         ".glb } ]\n"
         "exposure: { white_luminance: 3800 }\n"
         "view: { eye: [-2.6, 2.6, 1.6], target: [0.6, -1.2, 1.05], vertical_fov_deg: 56 }\n"
         "sun: { azimuth_deg: 160, elevation_deg: 38, illuminance_lux: 80000, color: [1, 0.94, 0.84], "
         "angular_radius_deg: 0 }\n";
}

}  // namespace bench_scenes
