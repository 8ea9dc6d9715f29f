#pragma once

#include <GLES3/gl31.h>

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <unordered_map>
#include <vector>

#include "render/scene/model.h"

namespace render {

// A Model uploaded: one vertex array a mesh, one mipmapped texture an image and use. Move-only; lives and dies on the
// thread of its GL context. Vertex attributes: 0 position, 1 normal, 2 tangent, 3 uv.
class GpuModel {
 public:
  struct MeshRange {
    int material = 0;
    GLsizei index_count = 0;
    std::size_t first_index = 0;  // in the model's index buffer
  };
  // Texture names of a material's slots; 0 where the material has none.
  struct Textures {
    GLuint base_color = 0;
    GLuint metallic_roughness = 0;
    GLuint normal = 0;
    GLuint occlusion = 0;
    GLuint emissive = 0;
  };

  // Base colour and emissive images go up as sRGB, the others as linear; anisotropic filtering where the driver has it.
  explicit GpuModel(const Model& model);
  ~GpuModel();
  GpuModel(const GpuModel&) = delete;
  GpuModel& operator=(const GpuModel&) = delete;

  const std::vector<MeshRange>& meshes() const { return meshes_; }
  const Material& material(int index) const { return materials_[static_cast<std::size_t>(index)]; }
  const Textures& textures(int material) const { return textures_[static_cast<std::size_t>(material)]; }
  void draw(const MeshRange& mesh) const;  // with the current program; binds the model's vertex array

 private:
  GLuint texture_for(const Model& model, const TextureRef& ref, bool srgb, float alpha_cutoff);

  GLuint vertex_array_ = 0;
  GLuint vertex_buffer_ = 0;
  GLuint index_buffer_ = 0;
  std::vector<MeshRange> meshes_;
  std::vector<Material> materials_;
  std::vector<Textures> textures_;
  std::unordered_map<std::uint64_t, GLuint> texture_names_;
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
