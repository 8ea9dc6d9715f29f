#pragma once

#include "render/sky/sky_models.h"

namespace render {

// Each model says what it is in the file that makes it; sky_models() lists them in this order.
SkyModelInfo perez_model();
SkyModelInfo preetham_model();
SkyModelInfo preetham_rescaled_model();
SkyModelInfo cie_model();
SkyModelInfo scattering_model();
SkyModelInfo reference_model();
SkyModelInfo image_model();
SkyModelInfo black_model();

}  // namespace render
