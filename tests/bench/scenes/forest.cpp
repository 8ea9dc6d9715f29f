#include <algorithm>
#include <cmath>

#include "data/generator/noise.h"
#include "data/generator/random.h"
#include "data/generator/solids.h"
#include "data/generator/textures.h"
#include "render/scene/mesh_tools.h"
#include "tests/bench/scenes/scenes.h"

namespace bench_scenes {
namespace {

constexpr float kHalf = 13.0F;  // the wood is 26 m across
const glm::vec3 kUp(0, 0, 1);

enum Part : std::size_t { Ground, Bark, Leaves, Fern, PartCount };

struct Grain {
  int ground_cells;
  int trunk_sides;
  int branches;
  int leaves_a_branch;
  float leaf_m;
  int ferns;
};

float ground_z(const glm::vec2& p) {
  const float path = -0.2F * std::exp(-0.15F * p.x * p.x);
  const float hill = 4.5F * glm::smoothstep(3.0F, 19.0F, p.y);  // hides the horizon
  return 0.45F * generator::fractal(p * 0.11F + 7.0F, {64, 64}, 3, 5) + path + hill;
}

class Forest {
 public:
  Forest(render::Model& model, const Grain& grain) : model_(model), grain_(grain) {}

  void build() {
    ground();
    for (const glm::vec2& place : places()) tree(place);
    for (int i = 0; i < grain_.ferns; ++i) {
      fern({random_.uniform(-kHalf, kHalf), random_.uniform(-0.85F * kHalf, 1.2F * kHalf)});
    }
  }

 private:
  void ground() {
    render::Mesh& mesh = model_.meshes[Ground];
    const auto row = static_cast<std::uint32_t>(grain_.ground_cells + 1);
    for (std::uint32_t j = 0; j < row; ++j) {
      for (std::uint32_t i = 0; i < row; ++i) {
        const glm::vec2 p = (glm::vec2(i, j) / static_cast<float>(row - 1) * 2.0F - 1.0F) * (kHalf + 6.0F);
        constexpr float kStep = 0.1F;
        const glm::vec3 normal(ground_z(p - glm::vec2(kStep, 0)) - ground_z(p + glm::vec2(kStep, 0)),
                               ground_z(p - glm::vec2(0, kStep)) - ground_z(p + glm::vec2(0, kStep)), 2.0F * kStep);
        mesh.vertices.push_back({glm::vec3(p, ground_z(p)), glm::normalize(normal), glm::vec4(0.0F), p / 0.7F});
      }
    }
    for (std::uint32_t j = 0; j + 1 < row; ++j) {
      for (std::uint32_t i = 0; i + 1 < row; ++i) {
        const std::uint32_t a = j * row + i;
        mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + row + 1, a, a + row + 1, a + row});
      }
    }
  }

  // A jittered grid, open where the eye looks along a path.
  std::vector<glm::vec2> places() {
    std::vector<glm::vec2> out;
    constexpr int kRows = 6;
    constexpr float kCell = 2.0F * kHalf / kRows;
    for (int j = 0; j < kRows; ++j) {
      for (int i = 0; i < kRows; ++i) {
        const glm::vec2 p = glm::vec2((static_cast<float>(i) + random_.uniform(0.2F, 0.8F)) * kCell - kHalf,
                                      (static_cast<float>(j) + random_.uniform(0.2F, 0.8F)) * kCell - kHalf);
        const bool near_eye = glm::distance(p, glm::vec2(0.6F, -13.5F)) < 5.5F;
        const bool on_path = p.y < 5.0F && std::abs(p.x) < 1.3F;
        if (!near_eye && !on_path) out.push_back(p);
      }
    }
    return out;
  }

  void tree(const glm::vec2& place) {
    const float height = random_.uniform(11.0F, 14.5F);
    const float radius = random_.uniform(0.16F, 0.30F);
    const glm::vec3 foot(place, ground_z(place) - 0.15F);
    const glm::vec3 lean(random_.uniform(-0.6F, 0.6F), random_.uniform(-0.6F, 0.6F), 0.0F);
    const float bend = random_.uniform(-0.3F, 0.3F);
    const auto axis = [&](float t) {
      return foot + t * (height * kUp + lean) + bend * std::sin(5.0F * t) * glm::vec3(0.7F, 0.7F, 0.0F);
    };
    std::vector<glm::vec3> points;
    std::vector<float> radii;
    constexpr int kSteps = 10;
    for (int i = 0; i <= kSteps; ++i) {
      const float t = static_cast<float>(i) / kSteps;
      const float root = 0.9F * std::exp(-14.0F * t);  // spreads into the ground
      points.push_back(axis(t * t * 0.3F + 0.7F * t));
      radii.push_back(i == kSteps ? 0.0F : radius * (1.0F + root) * (1.0F - 0.75F * t));
    }
    generator::tube(model_.meshes[Bark], points, radii, grain_.trunk_sides, 0.5F);
    for (int i = 0; i < grain_.branches; ++i) {
      const float t =
          0.36F + 0.62F * (static_cast<float>(i) + random_.uniform(0.1F, 0.9F)) / static_cast<float>(grain_.branches);
      branch(axis(t), t, height);
    }
  }

  void branch(const glm::vec3& root, float t, float height) {
    const float turn = random_.uniform(0.0F, 6.2831853F);
    const float reach = height * random_.uniform(0.16F, 0.26F) * (1.25F - t);
    const glm::vec3 out(std::cos(turn), std::sin(turn), random_.uniform(0.15F, 0.7F));
    const glm::vec3 tip = root + reach * out;
    const glm::vec3 middle = glm::mix(root, tip, 0.5F) + 0.12F * reach * random_.on_sphere();
    generator::tube(model_.meshes[Bark], {root, middle, tip}, {0.05F * (1.3F - t), 0.025F, 0.0F}, 4, 0.5F);
    for (int i = 0; i < grain_.leaves_a_branch; ++i) {
      const float along = std::sqrt(random_.uniform(0.06F, 1.1F));
      const glm::vec3 at = root + along * (tip - root) + 0.34F * reach * along * random_.on_sphere();
      leaf(at, glm::normalize(at - root + 0.5F * random_.on_sphere()));
    }
  }

  // A pointed leaf of two halves, folded along its rib, mostly level.
  void leaf(const glm::vec3& foot, const glm::vec3& away) {
    const float size = grain_.leaf_m * random_.uniform(0.7F, 1.25F);
    const glm::vec3 along = glm::normalize(away * glm::vec3(1, 1, 0.35F) - 0.25F * kUp);
    const glm::vec3 tilted = glm::normalize(kUp + 0.55F * random_.on_sphere());
    const glm::vec3 across = glm::normalize(glm::cross(along, tilted));
    const glm::vec3 face = glm::cross(across, along);
    render::Mesh& mesh = model_.meshes[Leaves];
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const float shade = random_.uniform(0.05F, 0.95F);
    const auto corner = [&](float x, float y, float z) {
      mesh.vertices.push_back({foot + size * (x * across + y * along + z * face),
                               glm::normalize(face + 0.6F * x * across),
                               glm::vec4(0.0F),
                               {shade, 0.5F}});
    };
    corner(0.0F, 0.0F, 0.0F);
    corner(0.33F, 0.42F, 0.08F);
    corner(0.0F, 1.0F, -0.10F);
    corner(-0.33F, 0.42F, 0.08F);
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
  }

  // Fronds that arch out from the ground, each a strip that ends in a point.
  void fern(const glm::vec2& place) {
    render::Mesh& mesh = model_.meshes[Fern];
    const glm::vec3 foot(place, ground_z(place) - 0.02F);
    constexpr int kFronds = 7;
    for (int k = 0; k < kFronds; ++k) {
      const float turn = 6.2831853F * (static_cast<float>(k) + random_.uniform(0.0F, 0.7F)) / kFronds;
      const glm::vec3 out(std::cos(turn), std::sin(turn), 0.0F);
      const glm::vec3 across(-out.y, out.x, 0.0F);
      const float size = random_.uniform(0.35F, 0.75F);
      const float shade = random_.uniform(0.1F, 0.9F);
      constexpr std::uint32_t kSteps = 3;
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (std::uint32_t i = 0; i <= kSteps; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(kSteps);
        const glm::vec3 rib = foot + size * (t * out + (1.1F * t - 0.95F * t * t) * kUp);
        const float half = size * 0.16F * std::sin(3.14159F * (0.12F + 0.88F * t)) * (1.0F - 0.6F * t);
        for (const float side : {-1.0F, 1.0F}) {
          mesh.vertices.push_back({rib + side * half * across + 0.02F * kUp,
                                   glm::normalize(kUp + 0.5F * (t - 0.3F) * out),
                                   glm::vec4(0.0F),
                                   {shade, 0.5F}});
        }
      }
      for (std::uint32_t i = 0; i < kSteps; ++i) {
        const std::uint32_t a = first + 2 * i;
        mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + 3, a, a + 3, a + 2});
      }
    }
  }

  render::Model& model_;
  Grain grain_;
  generator::Random random_{9};
};

// Shades of leaf green from left to right.
render::Image greens(const glm::vec3& dark, const glm::vec3& light) {
  render::Image image{.width = 16, .height = 4, .rgba = {}};
  for (int i = 0; i < image.width * image.height; ++i) {
    const glm::vec3 srgb = glm::mix(dark, light, static_cast<float>(i % image.width) / 15.0F);
    for (int c = 0; c < 3; ++c) image.rgba.push_back(static_cast<std::uint8_t>(255.0F * srgb[c]));
    // The reader keeps what a PNG holds, and a picture with alpha marks what light shines through (object.frag).
    image.rgba.push_back(i % image.width == 0 ? 254 : 255);
  }
  return image;
}

int add_foliage(render::Model& model, const std::string& name, const glm::vec3& dark, const glm::vec3& light) {
  const int index = add_material(model, name, std::vector<render::Image>{greens(dark, light)}, 0.55F);
  model.materials.back().alpha_mode = render::AlphaMode::Mask;
  model.materials.back().double_sided = true;
  return index;
}

}  // namespace

render::Model make_forest(Detail detail) {
  const bool coarse = detail == Detail::Coarse;
  render::Model model;
  model.name = coarse ? "forest-66k" : "forest-188k";
  model.meshes.resize(PartCount);
  const Grain grain = coarse ? Grain{40, 8, 18, 39, 0.46F, 160} : Grain{80, 12, 30, 76, 0.27F, 260};
  Forest(model, grain).build();
  model.meshes[Ground].material = add_material(model, "forest floor", generator::soil_textures(), 1.0F);
  model.materials.back().base_color = {0.42F, 0.34F, 0.20F, 1.0F};
  model.meshes[Bark].material = add_material(model, "bark", generator::bark_textures(), 0.95F);
  model.materials.back().base_color = {0.60F, 0.56F, 0.52F, 1.0F};
  model.meshes[Leaves].material = add_foliage(model, "leaves", {0.20F, 0.36F, 0.10F}, {0.45F, 0.58F, 0.20F});
  model.meshes[Fern].material = add_foliage(model, "fern", {0.16F, 0.33F, 0.10F}, {0.36F, 0.52F, 0.18F});
  render::update_bounds(model);
  return model;
}

std::string forest_yaml(const std::string& model) {
  return "# A wood in the morning: the sun stands behind the crowns, mist hangs among the trunks.\n"
         "skyshaft: 1\n"
         "sky: { model: perez, turbidity: 3 }\n"
         "medium: { extinction: 0.028, albedo: 0.95, phase: hg, g: 0.6, extent: { box: [[-14, -15, -1], [14, 14, 15]] "
         "} }\n"
         "objects: [ { model: " +
         model +
         ".glb } ]\n"
         "exposure: { white_luminance: 32000 }\n"
         "view: { eye: [0.6, -13.5, 1.7], target: [-0.4, 0, 4.6], vertical_fov_deg: 52 }\n"
         "sun: { azimuth_deg: 14, elevation_deg: 43, illuminance_lux: 260000, color: [1, 0.91, 0.76], "
         "angular_radius_deg: 0 }\n";
}

}  // namespace bench_scenes
