#pragma once

#include <GLES3/gl31.h>

#include <cstddef>
#include <map>
#include <memory>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "render/gl/buffer.h"
#include "render/gl/texture.h"
#include "render/scene/model.h"

namespace render {

// A Model uploaded: one vertex and index buffer, one mipmapped texture for each image and way of using it. Lives and
// dies on the thread of its GL context. Vertex attributes: 0 position, 1 normal, 2 tangent, 3 uv.
class GpuModel {
 public:
  struct MeshRange {
    int material = 0;
    GLsizei index_count = 0;
    std::size_t first_index = 0;  // in the model's index buffer
  };
  // Textures of a material's slots; null where the material has none.
  struct Textures {
    const gl::Texture* base_color = nullptr;
    const gl::Texture* metallic_roughness = nullptr;
    const gl::Texture* normal = nullptr;
    const gl::Texture* occlusion = nullptr;
    const gl::Texture* emissive = nullptr;
  };

  // Base colour and emissive images go up as sRGB, the others as linear; anisotropic filtering where a GPU offers it.
  explicit GpuModel(const Model& model);

  const std::vector<MeshRange>& meshes() const { return meshes_; }
  const Material& material(int index) const { return materials_[static_cast<std::size_t>(index)]; }
  const Textures& textures(int material) const { return textures_[static_cast<std::size_t>(material)]; }
  void draw(const MeshRange& mesh) const;  // with the current program; binds the model's vertex array

 private:
  void upload_geometry(const Model& model);
  const gl::Texture* texture_for(const Model& model, const TextureRef& ref, bool srgb);

  gl::Buffer vertices_;
  gl::Buffer indices_;
  gl::VertexArray vertex_array_;
  std::vector<MeshRange> meshes_;
  std::vector<Material> materials_;
  std::vector<Textures> textures_;
  std::map<std::tuple<int, TextureWrap, bool>, gl::Texture> uploaded_;  // image, wrap, sRGB
};

// One GpuModel a Model, shared by its instances. Keeps the Model alive while it is held.
class GpuModels {
 public:
  const GpuModel& get(const std::shared_ptr<const Model>& model);
  void forget_unused();  // drops models that nobody else holds any more

 private:
  struct Entry {
    std::shared_ptr<const Model> model;
    std::unique_ptr<GpuModel> gpu;
  };
  std::unordered_map<const Model*, Entry> entries_;
};

}  // namespace render
