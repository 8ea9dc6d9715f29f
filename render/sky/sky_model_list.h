#pragma once

#include "render/sky/sky_models.h"

namespace render {

// Each model says what it is in the file that makes it.
SkyModelInfo perez_model();
SkyModelInfo preetham_model();
SkyModelInfo preetham_rescaled_model();
SkyModelInfo cie_model();
SkyModelInfo scattering_model();
SkyModelInfo reference_model();
SkyModelInfo image_model();
SkyModelInfo black_model();

// All of them, in the order of the documents: what sky_models() holds.
inline constexpr SkyModelInfo (*kSkyModels[])() = {perez_model, preetham_model,   preetham_rescaled_model,
                                                   cie_model,   scattering_model, reference_model,
                                                   image_model, black_model};

}  // namespace render
