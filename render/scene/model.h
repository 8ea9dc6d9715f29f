#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "render/base/image.h"
#include "render/scene/convex_piece.h"

namespace render {

enum class AlphaMode { Opaque, Mask, Blend };
enum class TextureWrap { Repeat, Mirror, Clamp };

// Reference to an image of the model; image < 0 means none.
struct TextureRef {
  int image = -1;
  TextureWrap wrap = TextureWrap::Repeat;
};

// glTF 2.0 metallic-roughness material. Base colour and emissive images are sRGB, the others linear.
struct Material {
  std::string name;
  glm::vec4 base_color{1.0F};
  TextureRef base_color_texture;
  float metallic = 1.0F;
  float roughness = 1.0F;
  TextureRef metallic_roughness_texture;  // g roughness, b metallic
  TextureRef normal_texture;
  float normal_scale = 1.0F;
  TextureRef occlusion_texture;  // r
  float occlusion_strength = 1.0F;
  glm::vec3 emissive{0.0F};  // relative to white paper in the scene's light
  TextureRef emissive_texture;
  AlphaMode alpha_mode = AlphaMode::Opaque;
  float alpha_cutoff = 0.5F;
  bool double_sided = false;
};

struct Vertex {
  glm::vec3 position;
  glm::vec3 normal;
  glm::vec4 tangent;  // w is the handedness, glTF
  glm::vec2 uv;
};

// Indexed triangles of one material, counter-clockwise seen from outside.
struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  int material = 0;
};

// A model with its nodes flattened, already in the world's axes: (x, -z, y) of glTF, metres.
struct Model {
  std::string name;
  std::vector<Mesh> meshes;
  std::vector<Material> materials;  // never empty
  std::vector<Image> images;
  glm::vec3 bounds_min{0.0F};
  glm::vec3 bounds_max{0.0F};
  std::vector<ConvexPiece> convex_pieces;  // find_convex_pieces()

  std::size_t triangle_count() const;
};

// Reads .glb or .gltf. Throws std::runtime_error that names the file, what is wrong or which required extension is
// not supported, and what would be accepted.
Model load_gltf(const std::filesystem::path& path);

// Procedural stand-ins for `real:` geometry: a horizontal square of that half-size about the origin at z = 0, and a
// box centred on the origin.
Model make_ground(float half_size_m = 500.0F);
Model make_box(const glm::vec3& size_m);

// One placing of a model. `real` things are seen by light and hide virtual things, but are never drawn.
struct Instance {
  std::string name;
  std::shared_ptr<const Model> model;
  glm::dmat4 world_from_model{1.0};
  bool real = false;
};

// world_from_model for the scene file's position, heading and scale.
glm::dmat4 place_model(const glm::dvec3& position_in_world, double heading_rad, double scale);

}  // namespace render
