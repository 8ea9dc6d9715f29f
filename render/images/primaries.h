#pragma once

#include <ImfChromaticities.h>

#include "render/base/image.h"

namespace render {

// Brings linear RGB of the primaries and white `source` (CIE 1931 x, y) to Rec. 709's through CIE XYZ, without
// chromatic adaptation: what was measured stays. Values must be below 1e30. Throws std::runtime_error for
// chromaticities that span no colours (three on a line, not finite).
void to_rec709(const Imf::Chromaticities& source, LinearImage& image);

}  // namespace render
