#include "render/composite/surface_programs.h"

#include <array>
#include <string>
#include <vector>

namespace render {
namespace {

constexpr std::array<const char*, 10> kFeatures{
    "VIRTUAL_CASTERS", "REAL_CASTERS", "BASE_COLOR_TEXTURE", "METALLIC_ROUGHNESS_TEXTURE",
    "NORMAL_TEXTURE",  "ALPHA_MASK",   "OCCLUSION_TEXTURE",  "EMISSIVE_TEXTURE",
    "ALPHA_BLEND",     "THIN"};

unsigned bit(bool on, unsigned index) {
  return on ? 1U << index : 0U;
}

gl::Defines defines_of(unsigned features, const char* blocker_taps, const char* filter_taps) {
  gl::Defines defines{{"SHADED"}, {"BLOCKER_TAPS", blocker_taps}, {"FILTER_TAPS", filter_taps}};
  for (unsigned i = 0; i < kFeatures.size(); ++i) {
    if ((features & (1U << i)) != 0) defines.push_back({kFeatures[i]});
  }
  return defines;
}

unsigned features_of(const Material& material, const GpuModel::Textures& textures, SurfacePrograms::Casts casts) {
  const bool mask = material.alpha_mode == AlphaMode::Mask && textures.base_color != nullptr;
  return bit(casts.virtual_casters, 0) | bit(casts.real_casters, 1) | bit(textures.base_color != nullptr, 2) |
         bit(textures.metallic_roughness != nullptr, 3) | bit(textures.normal != nullptr, 4) | bit(mask, 5) |
         bit(textures.occlusion != nullptr, 6) | bit(textures.emissive != nullptr, 7) |
         bit(material.alpha_mode == AlphaMode::Blend, 8) |
         // Cut-out, two-sided: leaves, grass, netting. Two-sided alone says nothing: many exporters set it for all.
         bit(mask && material.double_sided, 9);
}

void bind_texture(const gl::Program& program, const char* uniform, const gl::Texture* texture, int unit) {
  if (texture == nullptr) return;
  texture->bind(unit);
  program.set(uniform, unit);
}

}  // namespace

const gl::Program& SurfacePrograms::object(const Material& material, const GpuModel::Textures& textures, Casts casts) {
  const unsigned features = features_of(material, textures, casts);
  auto found = object_.find(features);
  if (found == object_.end()) {
    found =
        object_
            .emplace(features, gl::Program("scene/surface.vert", "scene/object.frag", defines_of(features, "4", "8")))
            .first;
  }
  return found->second;
}

const gl::Program& SurfacePrograms::real_shadow(Casts casts) {
  const unsigned features = bit(casts.virtual_casters, 0) | bit(casts.real_casters, 1);
  auto found = real_shadow_.find(features);
  if (found == real_shadow_.end()) {
    gl::Defines defines = defines_of(features, "8", "16");
    defines.erase(defines.begin());  // not SHADED: needs no texture coordinates
    found = real_shadow_.emplace(features, gl::Program("scene/surface.vert", "scene/real_shadow.frag", defines)).first;
  }
  return found->second;
}

void SurfacePrograms::set_material(const gl::Program& program, const Material& material,
                                   const GpuModel::Textures& textures) {
  program.set("base_color", material.base_color);
  program.set("metallic", material.metallic);
  program.set("roughness", material.roughness);
  program.set("emissive", material.emissive);
  program.set("normal_scale", material.normal_scale);
  program.set("occlusion_strength", material.occlusion_strength);
  program.set("alpha_cutoff", material.alpha_cutoff);
  bind_texture(program, "base_color_texture", textures.base_color, 0);
  bind_texture(program, "metallic_roughness_texture", textures.metallic_roughness, 1);
  bind_texture(program, "normal_texture", textures.normal, 2);
  bind_texture(program, "occlusion_texture", textures.occlusion, 3);
  bind_texture(program, "emissive_texture", textures.emissive, 4);
}

}  // namespace render
