#include "render/gl/gpu_model.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <string_view>

#include "render/gl/extensions.h"

namespace render {
namespace {

GLenum gl_wrap(TextureWrap wrap) {
  switch (wrap) {
    case TextureWrap::Repeat:
      return GL_REPEAT;
    case TextureWrap::Mirror:
      return GL_MIRRORED_REPEAT;
    case TextureWrap::Clamp:
      break;
  }
  return GL_CLAMP_TO_EDGE;
}

// Leaves seen at a slant need it; more than 4 shows no difference on them.
float anisotropy() {
  const auto* names = reinterpret_cast<const char*>(glGetString(GL_EXTENSIONS));
  if (std::string_view(names).find("GL_EXT_texture_filter_anisotropic") == std::string_view::npos) return 1.0F;
  float most = 1.0F;
  glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
  return std::min(most, 4.0F);
}

}  // namespace

GpuModel::GpuModel(const Model& model) : materials_(model.materials) {
  upload_geometry(model);
  for (const Material& material : materials_) {
    textures_.push_back({.base_color = texture_for(model, material.base_color_texture, true),
                         .metallic_roughness = texture_for(model, material.metallic_roughness_texture, false),
                         .normal = texture_for(model, material.normal_texture, false),
                         .occlusion = texture_for(model, material.occlusion_texture, false),
                         .emissive = texture_for(model, material.emissive_texture, true)});
  }
}

void GpuModel::upload_geometry(const Model& model) {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  for (const Mesh& mesh : model.meshes) {
    const auto first_vertex = static_cast<std::uint32_t>(vertices.size());
    meshes_.push_back({mesh.material, static_cast<GLsizei>(mesh.indices.size()), indices.size()});
    vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const std::uint32_t index : mesh.indices) indices.push_back(first_vertex + index);
  }
  vertex_array_.bind();
  vertices_ = gl::Buffer(std::span<const Vertex>(vertices));
  indices_ = gl::Buffer(std::span<const std::uint32_t>(indices));
  vertex_array_.attribute(0, vertices_, 3, GL_FLOAT, false, sizeof(Vertex), offsetof(Vertex, position));
  vertex_array_.attribute(1, vertices_, 3, GL_FLOAT, false, sizeof(Vertex), offsetof(Vertex, normal));
  vertex_array_.attribute(2, vertices_, 4, GL_FLOAT, false, sizeof(Vertex), offsetof(Vertex, tangent));
  vertex_array_.attribute(3, vertices_, 2, GL_FLOAT, false, sizeof(Vertex), offsetof(Vertex, uv));
  vertex_array_.indices(indices_);
}

const gl::Texture* GpuModel::texture_for(const Model& model, const TextureRef& ref, bool srgb) {
  if (ref.image < 0) return nullptr;
  gl::Texture& texture = uploaded_[{ref.image, ref.wrap, srgb}];
  if (texture) return &texture;
  const Image& image = model.images.at(static_cast<std::size_t>(ref.image));
  texture = gl::Texture(srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, image.width, image.height, gl::Filter::Mipmap, 0, "model");
  texture.upload(GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  texture.generate_mipmaps();
  texture.set_wrap(gl_wrap(ref.wrap), gl_wrap(ref.wrap));
  if (gl::extensions().software) {  // which pays for every sample of a texture
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  } else if (const float most = anisotropy(); most > 1.0F) {
    glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY_EXT, most);
  }
  return &texture;
}

void GpuModel::draw(const MeshRange& mesh) const {
  vertex_array_.bind();
  glDrawElements(GL_TRIANGLES, mesh.index_count, GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(mesh.first_index * sizeof(std::uint32_t)));
}

const GpuModel& GpuModels::get(const std::shared_ptr<const Model>& model) {
  Entry& entry = entries_[model.get()];
  if (!entry.gpu) entry = {model, std::make_unique<GpuModel>(*model)};
  return *entry.gpu;
}

void GpuModels::forget_unused() {
  std::erase_if(entries_, [](const auto& item) { return item.second.model.use_count() == 1; });
}

}  // namespace render
