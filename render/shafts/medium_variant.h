#pragma once

#include <compare>
#include <vector>

#include "render/gl/shader_source.h"

namespace render {

// What media, views and pictures a shader over shaders/shafts/ray.glsl is compiled for.
struct MediumVariant {
  enum class Depth { None, OfPixel, OfSeveral };  // what a pixel's ray ends at: nothing; or a pixel stands for several

  bool bounded = false;            // the medium is a box
  bool falloff = false;            // it thins out with height
  Depth depth = Depth::OfPixel;    // of the ideal picture
  bool cascade = false;            // only the medium in a range of distances is looked at
  bool sky_at_corners = false;     // the sky's light is told by the corners of cells
  bool sun_disc = false;           // the sun is looked at as a disc, past:
  bool virtual_occluders = false;  // these
  bool real_occluders = false;     // and those

  auto operator<=>(const MediumVariant&) const = default;

  gl::Defines defines() const;
};

// All that a shader may be asked for: with or without cells' corners and the sun's disc.
struct MediumVariantLimits {
  bool sky_at_corners = false;
  bool sun_disc = false;
  bool cascades = true;
};
std::vector<MediumVariant> medium_variants(const MediumVariantLimits& limits);

}  // namespace render
