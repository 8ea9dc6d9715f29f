#pragma once

#include <memory>

#include "render/sky/sky_model.h"

namespace render {

// Hoffman & Preetham 2002 as Yang et al. 2007 use it (eq. 2-8): one scattering in air of constant density along a path
// that grows with the air mass, Rayleigh plus Henyey-Greenstein, at three wavelengths that stand for R, G and B.
std::unique_ptr<SkyModel> make_scattering_sky(double turbidity, const SunPosition& sun);

}  // namespace render
