#pragma once

#include <memory>

#include "render/sky/sky_model.h"

namespace render {

// Light that is there without the sun: `moonlit`, a sky lit by the moon as if it were the sun, in the proportion
// `moon_share` (moon_to_sun()), and airglow with starlight, 8e-4 lux on level ground, brighter towards the horizon (van
// Rhijn 1921). `moonlit` may be null.
std::unique_ptr<SkyModel> make_night_sky(std::unique_ptr<SkyModel> sky, std::unique_ptr<SkyModel> moonlit,
                                         double moon_share);

}  // namespace render
