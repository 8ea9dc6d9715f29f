#pragma once

#include <compare>
#include <vector>

#include "render/gl/shader_source.h"

namespace render {

// Samples of a soft shadow: to find what casts it, and to filter it.
struct ShadowTaps {
  int blocker = 4;
  int filter = 8;
  auto operator<=>(const ShadowTaps&) const = default;
};

// What of the surfaces' shaders a program is compiled for.
struct SurfaceVariant {
  bool virtual_occluders = false;
  bool real_occluders = false;
  bool translucent = false;  // occluders that tint the light
  bool base_color_texture = false;
  bool metallic_roughness_texture = false;
  bool normal_texture = false;
  bool occlusion_texture = false;
  bool emissive_texture = false;
  bool alpha_mask = false;
  bool alpha_blend = false;
  bool thin = false;      // light comes through: leaves, grass, netting
  bool marked = false;    // leaves a mark to know the surface by
  bool sought = false;    // real_shadow.frag: only where there may be a shadow
  bool textured = false;  // surface.vert hands on what textures need
  ShadowTaps taps{0, 0};  // 0: no shadow is looked for

  auto operator<=>(const SurfaceVariant&) const = default;

  gl::Defines defines() const;
};

// Of object.frag: each of the features alone, and those that meet in materials that are used.
std::vector<SurfaceVariant> object_variants();
// Of real_shadow.frag: all.
std::vector<SurfaceVariant> real_shadow_variants();

}  // namespace render
