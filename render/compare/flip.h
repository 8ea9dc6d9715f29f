#pragma once

#include "render/compare/filter.h"
#include "render/scene/model.h"

namespace render {

// Pixels per degree of 0.7 m from a monitor 0.7 m wide with 3840 pixels across, which FLIP takes where nothing is
// known.
inline constexpr double kFlipPixelsPerDegree = 67.02064327658225;

// The difference that a person sees who flips between two 8-bit sRGB pictures, 0 to 1 a pixel [Andersson, Nilsson,
// Akenine-Moeller, Oskarsson, Astroem & Fairchild 2020, "FLIP: a difference evaluator for alternating images"]. The
// pictures are of one size; throws std::invalid_argument else.
Plane flip(const Image& test, const Image& truth, double pixels_per_degree = kFlipPixelsPerDegree);

}  // namespace render
