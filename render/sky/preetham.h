#pragma once

#include "render/sky/perez.h"

namespace render {

// Preetham, Shirley, Smits 1999, appendix A.2: the distribution of luminance and chromaticity of a clear sky.
struct PreethamShapes {
  PerezShape luminance;
  PerezShape x;
  PerezShape y;
};

// The paper's coefficients for turbidity, which is held inside [2, 10]: below 2 the published luminance runs into a
// division by zero at 1.64, above 10 it turns negative at low sun.
PreethamShapes preetham_shapes(double turbidity);

// Zenith values.
struct PreethamZenith {
  double luminance_kcdm2 = 0.0;
  double x = 0.0;
  double y = 0.0;
};

// Appendix A.2 for turbidity in [2, 10] and the sun's zenith angle in [0, pi/2], both held there. The published
// luminance is about 2.3 times too bright.
PreethamZenith preetham_zenith(double turbidity, double sun_zenith_rad);

}  // namespace render
