#pragma once

#include "ar/track/lens.h"
#include "ar/track/solve.h"

namespace ar {

// The detector fits straight lines to a tag's edges and calls their crossings the corners. Where the lens bends the
// edges, those crossings are not the corners' pictures: near the border of a wide picture by a pixel and more. Sets
// tag.corners_px to tag.measured_px less that difference, as the model predicts it for that pose.
void straighten(const Lens& lens, const Rigid3& world_from_camera, SeenTag& tag);

}  // namespace ar
