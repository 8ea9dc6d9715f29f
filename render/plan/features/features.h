#pragma once

#include <span>

#include "render/plan/feature.h"

namespace render {

// All features there are, in the order in which a frame runs them. A new one is a file in this folder, a declaration
// below and its place in the list of features.cpp.
std::span<const Feature* const> features();

namespace feature {

extern const Feature kBackground;    // the sky behind a still
extern const Feature kShadow;        // the sun's shadow maps
extern const Feature kObjects;       // real surfaces' depth and shadow, virtual objects
extern const Feature kCascades;      // shadow maps for the medium that is seen
extern const Feature kShafts;        // light scattered by the medium
extern const Feature kTranslucency;  // its tint by translucent occluders
extern const Feature kMedium;        // what the medium alone adds and lets through
extern const Feature kUpload;        // the real picture to the GL
extern const Feature kComposite;     // layers over the picture
extern const Feature kMerge;         // layers smaller than the picture into one
extern const Feature kRead;          // out of the GL
extern const Feature kOverlay;       // that one layer over the picture, by the CPU

}  // namespace feature
}  // namespace render
