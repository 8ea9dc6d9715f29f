#include "render/surface/surface_programs.h"

#include <string>
#include <utility>

namespace render {
namespace {

// Only what shows in the depth: few variants.
SurfaceVariant depth_variant(const Material& material, const GpuModel::Textures& textures) {
  const bool cut_out = is_cut_out(material, textures);
  return {.alpha_mask = cut_out, .textured = cut_out};
}

SurfaceVariant light_variant(const Material& material, const GpuModel::Textures& textures,
                             SurfacePrograms::Casts casts) {
  const bool cut_out = is_cut_out(material, textures);
  return {.virtual_occluders = casts.virtual_occluders,
          .real_occluders = casts.real_occluders,
          .translucent = casts.translucent,
          .base_color_texture = textures.base_color != nullptr,
          .metallic_roughness_texture = textures.metallic_roughness != nullptr,
          .normal_texture = textures.normal != nullptr,
          .occlusion_texture = textures.occlusion != nullptr,
          .emissive_texture = textures.emissive != nullptr,
          .alpha_mask = cut_out,
          .alpha_blend = material.alpha_mode == AlphaMode::Blend,
          // Cut-out, two-sided: leaves, grass, netting. Two-sided alone says nothing: many exporters set it for all.
          .thin = cut_out && material.double_sided,
          .textured = true};
}

void bind_texture(const gl::Program& program, const char* sampler, const gl::Texture* texture) {
  if (texture != nullptr && program.has(sampler)) program.bind(sampler, texture->handle());
}

// Of what a variant's features ask for.
template <typename T>
void set_where_read(const gl::Program& program, const char* uniform, const T& value) {
  if (program.has(uniform)) program.set(uniform, value);
}

}  // namespace

bool is_cut_out(const Material& material, const GpuModel::Textures& textures) {
  return material.alpha_mode == AlphaMode::Mask && textures.base_color != nullptr;
}

const gl::Program& SurfacePrograms::virtual_surface(Use use, const Material& material,
                                                    const GpuModel::Textures& textures, Casts casts) {
  SurfaceVariant variant =
      use == Use::Depth ? depth_variant(material, textures) : light_variant(material, textures, casts);
  if (use != Use::Depth) variant.taps = quick_shadows_ ? ShadowTaps{2, 3} : ShadowTaps{4, 8};
  variant.marked = use == Use::MarkedLight;
  const char* shader = use == Use::Depth         ? "surface/depth.frag"
                       : use == Use::SmoothEdges ? "surface/smooth.frag"
                                                 : "surface/object.frag";
  return program_for(shader, variant);
}

const gl::Program& SurfacePrograms::real_shadow(Casts casts, bool sought) {
  return program_for("surface/real_shadow.frag", {.virtual_occluders = casts.virtual_occluders,
                                                  .real_occluders = casts.real_occluders && !sought,
                                                  .translucent = casts.translucent,
                                                  .sought = sought,
                                                  .taps = quick_shadows_ ? ShadowTaps{3, 4} : ShadowTaps{8, 16}});
}

const gl::Program& SurfacePrograms::program_for(const char* shader, const SurfaceVariant& variant) {
  const auto found = programs_.find({shader, variant});
  if (found != programs_.end()) return found->second;
  return programs_
      .emplace(std::pair(std::string(shader), variant), gl::Program("surface/surface.vert", shader, variant.defines()))
      .first->second;
}

void SurfacePrograms::set_material(const gl::Program& program, const Material& material,
                                   const GpuModel::Textures& textures) {
  set_where_read(program, "base_color", material.base_color);
  set_where_read(program, "metallic", material.metallic);
  set_where_read(program, "roughness", material.roughness);
  set_where_read(program, "emissive", material.emissive);
  set_where_read(program, "normal_scale", material.normal_scale);
  set_where_read(program, "occlusion_strength", material.occlusion_strength);
  set_where_read(program, "alpha_cutoff", material.alpha_cutoff);
  bind_texture(program, "base_color_texture", textures.base_color);
  bind_texture(program, "metallic_roughness_texture", textures.metallic_roughness);
  bind_texture(program, "normal_texture", textures.normal);
  bind_texture(program, "occlusion_texture", textures.occlusion);
  bind_texture(program, "emissive_texture", textures.emissive);
}

}  // namespace render
