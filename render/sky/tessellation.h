#pragma once

#include <vector>

#include "render/sky/patches.h"

namespace render {

// The tessellations behind make_patches().
std::vector<SkyPatch> dome5728(const SkyModel& sky, const SkyVisibility& visibility);
std::vector<SkyPatch> dome144(const SkyModel& sky, const SkyVisibility& visibility);
std::vector<SkyPatch> geodesic(const SkyModel& sky, const PatchOptions& options);

}  // namespace render
