#pragma once

#include "render/sky/perez.h"

namespace render {

// Preetham, Shirley, Smits 1999, appendix A.2: the distribution of luminance and chromaticity of a clear sky.
struct PreethamShapes {
  PerezShape luminance;
  PerezShape x;
  PerezShape y;
};

// The paper's four-decimal coefficients for turbidity, which is held inside [1.7, 10]: at 1.643 the published luminance
// divides by zero, above 10 it turns negative at low sun. Real skies want 2 and more.
PreethamShapes preetham_shapes(double turbidity);

// Zenith values.
struct PreethamZenith {
  double luminance_kcdm2 = 0.0;
  double x = 0.0;
  double y = 0.0;
};

// Appendix A.2 for turbidity in [1.7, 10] and the sun's zenith angle in [0, pi/2], both held there. The published
// luminance is about 2.3 times too bright.
PreethamZenith preetham_zenith(double turbidity, double sun_zenith_rad);

}  // namespace render
