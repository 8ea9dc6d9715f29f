#pragma once

#include <memory>

#include "render/sky/sky_model.h"

namespace render {

// The sky that the others are judged by: sunlight scattered once, exactly, and many times, approximately (Hillaire
// 2020), in a spherical atmosphere of molecules, aerosol by turbidity and ozone, at eleven wavelengths. Valid from
// noon into the twilight. About 10 ms to make for a new sun once its turbidity is known.
std::unique_ptr<SkyModel> make_reference_sky(double turbidity, const SunPosition& sun);

// The same on a coarser table, about four times cheaper: good for colours, which change slowly over the sky.
std::unique_ptr<SkyModel> make_reference_colors(double turbidity, const SunPosition& sun);

}  // namespace render
