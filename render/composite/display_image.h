#pragma once

#include "render/images/image_io.h"

namespace render {

// The picture of linear light (cd/m2) for a display: times `exposure`, highlight shoulder, sRGB, dithered to 8 bits.
Image display_image(const LinearImage& linear, double exposure);

}  // namespace render
