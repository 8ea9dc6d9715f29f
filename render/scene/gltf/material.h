#pragma once

#include <glm/mat3x3.hpp>
#include <map>

#include "render/scene/gltf/document.h"
#include "render/scene/model.h"

namespace render::gltf {

// A material as the model keeps it, and what its textures ask of the meshes: which TEXCOORD_n, and the transform of
// KHR_texture_transform, texture_from_mesh on (u, v, 1).
struct MaterialSource {
  Material material;
  std::size_t uv_set = 0;
  glm::mat3 texture_from_mesh{1.0F};
};

// Decodes the images that materials name, each once, into `model`.
class MaterialReader {
 public:
  MaterialReader(const Document& document, Model& model) : document_(document), model_(model) {}

  // Throws std::runtime_error where values are out of range or an image cannot be decoded. All textures of a material
  // share one set of texture coordinates, the base colour's: another texture that needs a different one is left out
  // with a warning.
  MaterialSource read(std::size_t index);

 private:
  struct Texture {
    TextureRef ref;
    std::size_t uv_set = 0;
    glm::mat3 texture_from_mesh{1.0F};
  };
  Texture read_texture(const Json& info, const std::string& where);
  int load_image(std::size_t index);
  // Textures of one material, in order of importance; the first sets the coordinates.
  void use(const Json& holder, const char* key, TextureRef& ref, MaterialSource& source, const std::string& where);

  const Document& document_;
  Model& model_;
  std::map<std::size_t, int> image_of_;
  bool coordinates_set_ = false;
};

}  // namespace render::gltf
