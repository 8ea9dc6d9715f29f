#include "render/surface/surface_programs.h"

#include <array>
#include <string>
#include <vector>

namespace render {
namespace {

constexpr std::array<const char*, 11> kFeatures{
    "VIRTUAL_OCCLUDERS", "REAL_OCCLUDERS", "BASE_COLOR_TEXTURE", "METALLIC_ROUGHNESS_TEXTURE",
    "NORMAL_TEXTURE",    "ALPHA_MASK",     "OCCLUSION_TEXTURE",  "EMISSIVE_TEXTURE",
    "ALPHA_BLEND",       "THIN",           "TRANSLUCENT"};

unsigned bit(bool on, unsigned index) {
  return on ? 1U << index : 0U;
}

gl::Defines defines_of(unsigned features) {
  gl::Defines defines;
  for (unsigned i = 0; i < kFeatures.size(); ++i) {
    if ((features & (1U << i)) != 0) defines.push_back({kFeatures[i]});
  }
  return defines;
}

// Samples of a soft shadow: to find what casts it, and to filter it.
struct Taps {
  const char* blocker;
  const char* filter;
};

void add_taps(const Taps& taps, gl::Defines& defines) {
  defines.insert(defines.end(), {{"BLOCKER_TAPS", taps.blocker}, {"FILTER_TAPS", taps.filter}});
}

// Only what shows in the depth: few variants.
unsigned depth_features_of(const Material& material, const GpuModel::Textures& textures) {
  return bit(is_cut_out(material, textures), 5);
}

unsigned features_of(const Material& material, const GpuModel::Textures& textures, SurfacePrograms::Casts casts) {
  const bool cut_out = is_cut_out(material, textures);
  return bit(casts.virtual_occluders, 0) | bit(casts.real_occluders, 1) | bit(textures.base_color != nullptr, 2) |
         bit(textures.metallic_roughness != nullptr, 3) | bit(textures.normal != nullptr, 4) | bit(cut_out, 5) |
         bit(textures.occlusion != nullptr, 6) | bit(textures.emissive != nullptr, 7) |
         bit(material.alpha_mode == AlphaMode::Blend, 8) |
         // Cut-out, two-sided: leaves, grass, netting. Two-sided alone says nothing: many exporters set it for all.
         bit(cut_out && material.double_sided, 9) | bit(casts.translucent, 10);
}

void bind_texture(const gl::Program& program, const char* uniform, const gl::Texture* texture, int unit) {
  if (texture == nullptr) return;
  texture->bind(unit);
  program.set(uniform, unit);
}

}  // namespace

bool is_cut_out(const Material& material, const GpuModel::Textures& textures) {
  return material.alpha_mode == AlphaMode::Mask && textures.base_color != nullptr;
}

const gl::Program& SurfacePrograms::virtual_surface(Use use, const Material& material,
                                                    const GpuModel::Textures& textures, Casts casts) {
  const unsigned features =
      use == Use::Depth ? depth_features_of(material, textures) : features_of(material, textures, casts);
  const unsigned key = features | static_cast<unsigned>(use) << kFeatures.size();
  const auto found = virtual_.find(key);
  if (found != virtual_.end()) return found->second;
  gl::Defines defines = defines_of(features);
  if (use != Use::Depth || features != 0) defines.push_back({"TEXTURED"});
  if (use != Use::Depth) add_taps(quick_shadows_ ? Taps{"2", "3"} : Taps{"4", "8"}, defines);
  if (use == Use::MarkedLight) defines.push_back({"MARKED"});
  const char* shader = use == Use::Depth         ? "surface/depth.frag"
                       : use == Use::SmoothEdges ? "surface/smooth.frag"
                                                 : "surface/object.frag";
  return virtual_.emplace(key, gl::Program("surface/surface.vert", shader, defines)).first->second;
}

const gl::Program& SurfacePrograms::real_shadow(Casts casts, bool sought) {
  const unsigned features =
      bit(casts.virtual_occluders, 0) | bit(casts.real_occluders && !sought, 1) | bit(casts.translucent, 10);
  const unsigned key = features | bit(sought, kFeatures.size());
  const auto found = real_shadow_.find(key);
  if (found != real_shadow_.end()) return found->second;
  gl::Defines defines = defines_of(features);
  add_taps(quick_shadows_ ? Taps{"3", "4"} : Taps{"8", "16"}, defines);
  if (sought) defines.push_back({"SOUGHT"});
  return real_shadow_.emplace(key, gl::Program("surface/surface.vert", "surface/real_shadow.frag", defines))
      .first->second;
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
