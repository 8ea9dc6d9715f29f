#include "render/surface/surface_variant.h"

#include <array>
#include <string>
#include <utility>

namespace render {
namespace {

using Feature = std::pair<bool SurfaceVariant::*, const char*>;

constexpr std::array<Feature, 14> kFeatures{
    {{&SurfaceVariant::virtual_occluders, "VIRTUAL_OCCLUDERS"},
     {&SurfaceVariant::real_occluders, "REAL_OCCLUDERS"},
     {&SurfaceVariant::translucent, "TRANSLUCENT"},
     {&SurfaceVariant::base_color_texture, "BASE_COLOR_TEXTURE"},
     {&SurfaceVariant::metallic_roughness_texture, "METALLIC_ROUGHNESS_TEXTURE"},
     {&SurfaceVariant::normal_texture, "NORMAL_TEXTURE"},
     {&SurfaceVariant::occlusion_texture, "OCCLUSION_TEXTURE"},
     {&SurfaceVariant::emissive_texture, "EMISSIVE_TEXTURE"},
     {&SurfaceVariant::alpha_mask, "ALPHA_MASK"},
     {&SurfaceVariant::alpha_blend, "ALPHA_BLEND"},
     {&SurfaceVariant::thin, "THIN"},
     {&SurfaceVariant::marked, "MARKED"},
     {&SurfaceVariant::sought, "SOUGHT"},
     {&SurfaceVariant::textured, "TEXTURED"}}};

}  // namespace

gl::Defines SurfaceVariant::defines() const {
  gl::Defines defines;
  for (const auto& [member, name] : kFeatures) {
    if (this->*member) defines.push_back({name});
  }
  if (taps.filter > 0) {
    defines.push_back({"BLOCKER_TAPS", std::to_string(taps.blocker)});
    defines.push_back({"FILTER_TAPS", std::to_string(taps.filter)});
  }
  return defines;
}

std::vector<SurfaceVariant> object_variants() {
  const SurfaceVariant plain{.textured = true, .taps = {}};
  std::vector<SurfaceVariant> all{plain};
  SurfaceVariant everything = plain;
  for (const auto& [member, name] : kFeatures) {
    if (member == &SurfaceVariant::sought) continue;
    SurfaceVariant alone = plain;
    alone.*member = true;
    all.push_back(alone);
    if (member != &SurfaceVariant::alpha_blend && member != &SurfaceVariant::translucent) everything.*member = true;
  }
  all.push_back(everything);
  everything.translucent = true;
  all.push_back(everything);
  return all;
}

std::vector<SurfaceVariant> real_shadow_variants() {
  std::vector<SurfaceVariant> all;
  for (const bool sought : {false, true}) {
    for (const bool translucent : {false, true}) {
      for (const bool real : {false, true}) {
        if (real && sought) continue;
        all.push_back({.virtual_occluders = true,
                       .real_occluders = real,
                       .translucent = translucent,
                       .sought = sought,
                       .taps = {8, 16}});
      }
    }
  }
  return all;
}

}  // namespace render
