#include "render/shafts/medium_variant.h"

namespace render {

gl::Defines MediumVariant::defines() const {
  gl::Defines defines;
  if (bounded) defines.push_back({"BOUNDED"});
  if (falloff) defines.push_back({"FALLOFF"});
  if (depth == Depth::None) defines.push_back({"NO_DEPTH"});
  if (depth == Depth::OfSeveral) defines.push_back({"DIVIDED"});
  if (sky_at_corners) defines.push_back({"SKY_AT_CORNERS"});
  if (cascade) defines.push_back({"CASCADE"});
  if (sun_disc) defines.insert(defines.end(), {{"SUN_DISC"}, {"BLOCKER_TAPS", "8"}, {"FILTER_TAPS", "16"}});
  if (virtual_occluders) defines.push_back({"VIRTUAL_OCCLUDERS"});
  if (real_occluders) defines.push_back({"REAL_OCCLUDERS"});
  return defines;
}

std::vector<MediumVariant> medium_variants(const MediumVariantLimits& limits) {
  using Depth = MediumVariant::Depth;
  std::vector<MediumVariant> all{{}};
  const auto multiply = [&](auto member, auto value) {
    for (std::size_t i = all.size(); i-- > 0;) {
      all.push_back(all[i]);
      all.back().*member = value;
    }
  };
  multiply(&MediumVariant::bounded, true);
  multiply(&MediumVariant::falloff, true);
  if (limits.cascades) multiply(&MediumVariant::cascade, true);
  if (limits.sky_at_corners) multiply(&MediumVariant::sky_at_corners, true);
  const std::vector<MediumVariant> whole_pictures = all;
  for (const Depth depth : {Depth::None, Depth::OfSeveral}) {
    for (MediumVariant variant : whole_pictures) {
      variant.depth = depth;
      all.push_back(variant);
    }
  }
  if (!limits.sun_disc) return all;
  const std::vector<MediumVariant> points = all;
  for (const int kinds : {1, 2, 3}) {
    for (MediumVariant variant : points) {
      variant.sun_disc = true;
      variant.virtual_occluders = (kinds & 1) != 0;
      variant.real_occluders = (kinds & 2) != 0;
      all.push_back(variant);
    }
  }
  return all;
}

}  // namespace render
